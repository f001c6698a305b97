#include "RunTool.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <scene/ImageFile.h>

namespace {

using Arguments = std::vector<std::string>;

constexpr int kSize = 33; ///< odd: the middle pixel's ray runs along the view axis

const Arguments kView = {"triangle.gltf", "--eye", "0,0,5",         "--target", "0,0,0",
                         "--size",        "33x33", "--shadow-size", "64"};

constexpr const char* kMedium =
    R"({"constituents": [{"scattering": [0.1, 0.2, 0.3], "phase": "isotropic"}], "absorption": [0.02, 0.02, 0.02]})";

Arguments viewWith(const Arguments& more) {
  Arguments all = kView;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

float valueAt(const host::Image& image, const std::string& channel, int x, int y) {
  const std::vector<float>* values = image.find(channel);
  REQUIRE(values != nullptr);
  return values->at(static_cast<std::size_t>(y) * image.width + x);
}

} // namespace

TEST_CASE("tyndall-render writes what DESIGN 8 says into an EXR") {
  const tests::ToolFolder folder;
  folder.write("m.json", kMedium);
  const tests::ToolResult result =
      folder.run(viewWith({"--medium", "m.json", "--sun", "0,0,-1,6,5,4", "--out", "a.exr"}));
  CAPTURE(result.err);
  REQUIRE(result.exitCode == 0);
  CHECK(result.out.empty());
  const host::Image image = host::readExr(folder.path("a.exr"));
  CHECK(image.width == kSize);
  CHECK(image.height == kSize);
  CHECK(image.channels.size() == 10);

  const int middle = kSize / 2;
  CHECK(valueAt(image, "Z", middle, middle) == Approx(5).epsilon(1e-4));
  CHECK(valueAt(image, "Z", 0, 0) == 1e30F);
  const double extinction[] = {0.12, 0.22, 0.32};
  const double scattering[] = {0.1, 0.2, 0.3};
  const double irradiance[] = {6, 5, 4};
  const char* const letters[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    CAPTURE(letters[c]);
    const double transmittance = std::exp(-extinction[c] * 5);
    const std::string letter = letters[c];
    CHECK(valueAt(image, "transmittance." + letter, middle, middle) == Approx(transmittance).epsilon(1e-4));
    CHECK(valueAt(image, "transmittance." + letter, 0, 0) == Approx(0).margin(1e-6));
    // The sun shines along the view: nothing between eye and triangle is in shadow.
    const double inscatter =
        irradiance[c] * scattering[c] / (4 * 3.14159265358979323846) * (1 - transmittance) / extinction[c];
    CHECK(valueAt(image, "inscatter." + letter, middle, middle) == Approx(inscatter).epsilon(1e-4));
    CHECK(valueAt(image, letter, middle, middle) > inscatter);
  }
  // The triangle's tip points up: the row above the bottom of the picture sees its base, the row below the top does
  // not.
  CHECK(valueAt(image, "Z", middle, middle + 5) < 10);
  CHECK(valueAt(image, "Z", middle - 5, middle + 5) < 10);
  CHECK(valueAt(image, "Z", middle - 5, middle - 5) == 1e30F);
}

TEST_CASE("reversed depth makes the same picture") {
  const tests::ToolFolder folder;
  const Arguments sun = {"--sun", "0.3,-1,-0.5", "--out"};
  Arguments standard = viewWith(sun);
  standard.emplace_back("a.exr");
  Arguments reversed = viewWith(sun);
  reversed.insert(reversed.end(), {"b.exr", "--reversed-depth"});
  REQUIRE(folder.run(standard).exitCode == 0);
  REQUIRE(folder.run(reversed).exitCode == 0);
  const host::Image a = host::readExr(folder.path("a.exr"));
  const host::Image b = host::readExr(folder.path("b.exr"));
  for (const char* channel : {"R", "inscatter.G", "transmittance.B", "Z"})
    for (std::size_t i = 0; i < a.find(channel)->size(); ++i)
      REQUIRE(a.find(channel)->at(i) == Approx(b.find(channel)->at(i)).epsilon(2e-4).margin(1e-6));
}

TEST_CASE("tyndall-render writes statistics") {
  const tests::ToolFolder folder;
  const tests::ToolResult result =
      folder.run(viewWith({"--profile", "reference", "--repeat", "3", "--stats", "s.json"}));
  CAPTURE(result.err);
  REQUIRE(result.exitCode == 0);
  CHECK(result.out.empty());
  const nlohmann::json stats = nlohmann::json::parse(folder.read("s.json"));
  CHECK_FALSE(stats.at("driver").get<std::string>().empty());
  CHECK(stats.at("context") == (result.err.find("context egl is used") == std::string::npos ? "osmesa" : "egl"));
  CHECK(stats.at("size") == nlohmann::json({kSize, kSize}));
  CHECK(stats.at("technique") == "exact");
  CHECK(stats.at("profile") == "reference");
  const nlohmann::json& time = stats.at("effect_ms");
  CHECK(time.at("min") > 0);
  CHECK(time.at("min") <= time.at("median"));
  CHECK(time.at("median") <= time.at("max"));
  CHECK(stats.at("bytes") > 0);
  REQUIRE_FALSE(stats.at("passes").empty());
  for (const nlohmann::json& pass : stats.at("passes"))
    CHECK(pass.contains("name") != (pass.contains("ms") == pass.contains("skipped")));
  CHECK(stats.at("marched_samples") == kSize * kSize);
  CHECK(stats.at("fixup_pixels") == 0);
  for (const char* none : {"drawn_slices", "error_estimate", "share_over_target"})
    CHECK(stats.at(none) == 0);
  CHECK(stats.size() == 14);
}

TEST_CASE("tyndall-render says what an error target brought") {
  const tests::ToolFolder folder;
  REQUIRE(folder.run(viewWith({"--error-target", "0.02", "--stats", "s.json"})).exitCode == 0);
  const nlohmann::json stats = nlohmann::json::parse(folder.read("s.json"));
  CHECK(stats.at("drawn_slices") > 0);
  CHECK(stats.at("error_estimate") > 0);
  CHECK(stats.at("share_over_target") <= 1);
}

TEST_CASE("tyndall-render draws in bands the picture of whole draws, and its statistics tell the longest") {
  const tests::ToolFolder folder;
  for (const char* milliseconds : {"0", "0.001"}) {
    const std::string name = milliseconds;
    REQUIRE(folder
                .run(viewWith(
                    {"--profile", "reference", "--band-ms", name, "--out", name + ".exr", "--stats", name + ".json"}))
                .exitCode == 0);
  }
  CHECK(folder.read("0.exr") == folder.read("0.001.exr"));
  const auto isBanded = [](const nlohmann::json& pass) { return pass.contains("bands"); };
  const nlohmann::json whole = nlohmann::json::parse(folder.read("0.json")).at("passes");
  const nlohmann::json banded = nlohmann::json::parse(folder.read("0.001.json")).at("passes");
  CHECK(std::none_of(whole.begin(), whole.end(), isBanded));
  const auto found = std::find_if(banded.begin(), banded.end(), isBanded);
  REQUIRE(found != banded.end());
  CHECK(found->at("bands") > 1);
  CHECK(found->at("longest_ms") > 0);
  CHECK(found->at("longest_ms") < found->at("ms"));
}

TEST_CASE("the statistics tell what the shadows of smoke cost, if there are any") {
  const tests::ToolFolder folder;
  folder.write("smoke.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"extras": {"tyndall": {"smoke": {"particles": 20}}}}]})");
  const auto run = [&](const Arguments& more) {
    Arguments all = {"smoke.gltf", "--eye",         "0,1,5", "--target", "0,1,0", "--size",
                     "32x32",      "--shadow-size", "16",    "--stats",  "s.json"};
    all.insert(all.end(), more.begin(), more.end());
    const tests::ToolResult result = folder.run(all);
    CAPTURE(result.err);
    REQUIRE(result.exitCode == 0);
    return result;
  };
  run({"--avsm-size", "32", "--avsm-nodes", "4"});
  const nlohmann::json avsm = nlohmann::json::parse(folder.read("s.json")).at("avsm");
  REQUIRE(avsm.size() == 2);
  CHECK(avsm[0].at("light") == 0);
  CHECK(avsm[1].at("eye") == true);
  for (const nlohmann::json& map : avsm) {
    CHECK(map.at("segments") > 100);
    CHECK(map.at("lost") == 0);
    CHECK(map.at("list_bytes") > 32 * 32 * 32);
    CHECK(map.at("curve_bytes") == 32 * 32 * 16);
    CHECK(map.at("capture_ms") > 0);
    CHECK_FALSE(map.at("passes").empty());
  }
  run({"--no-eye-curves"});
  CHECK(nlohmann::json::parse(folder.read("s.json")).at("avsm").size() == 1);
  CHECK(run({"--no-avsm"}).err.find("smoke and strands") == std::string::npos);
  CHECK_FALSE(nlohmann::json::parse(folder.read("s.json")).contains("avsm"));
}

TEST_CASE("with --supersample an EXR keeps every pixel and a PNG their mean") {
  const tests::ToolFolder folder;
  REQUIRE(
      folder.run(viewWith({"--supersample", "3", "--out", "a.exr", "--out", "a.png", "--stats", "s.json"})).exitCode ==
      0);
  CHECK(host::readExr(folder.path("a.exr")).width == 3 * kSize);
  CHECK(nlohmann::json::parse(folder.read("s.json")).at("size") == nlohmann::json({3 * kSize, 3 * kSize}));
  const std::string png = folder.read("a.png");
  REQUIRE(png.size() > 24);
  for (const std::size_t side : {16, 20}) // width and height in the header, big-endian
    CHECK(static_cast<unsigned char>(png[side + 2]) * 256 + static_cast<unsigned char>(png[side + 3]) == kSize);
}

TEST_CASE("--view replaces the composite, or says what it needs") {
  const tests::ToolFolder folder;
  folder.write("m.json", kMedium);
  const Arguments sun = {"--medium", "m.json", "--sun", "0,0,-1,6,5,4"};
  const auto run = [&](const std::string& technique, const std::string& view) {
    Arguments all = viewWith({"--technique", technique, "--view", view, "--out", "v.exr", "--out", "v.png"});
    all.insert(all.end(), sun.begin(), sun.end());
    return folder.run(all);
  };
  for (const std::string output : {"inscatter", "transmittance"}) {
    REQUIRE(run("epipolar", output).exitCode == 0);
    const host::Image image = host::readExr(folder.path("v.exr"));
    CHECK(*image.find("G") == *image.find(output + ".G"));
  }
  for (const std::string view :
       {"slices", "samples", "breaks", "march-samples", "fixup-pixels", "node-visits", "difference", "composite"})
    CHECK(run("epipolar", view).exitCode == 0);
  const tests::ToolResult refused = run("exact", "slices");
  CHECK(refused.exitCode == 1);
  CHECK(refused.err.find("settings.debugView is Slices: needs slices") != std::string::npos);
}

TEST_CASE("a medium that does nothing leaves the passes skipped and the composite as it was") {
  const tests::ToolFolder folder;
  folder.write("m.json", R"({"constituents": [], "absorption": [0, 0, 0]})");
  REQUIRE(folder.run(viewWith({"--medium", "m.json", "--stats", "s.json", "--out", "a.exr"})).exitCode == 0);
  const nlohmann::json stats = nlohmann::json::parse(folder.read("s.json"));
  CHECK(stats.at("marched_samples") == 0);
  const host::Image image = host::readExr(folder.path("a.exr"));
  for (const float value : *image.find("inscatter.R"))
    REQUIRE(value == 0);
  for (const float value : *image.find("transmittance.G"))
    REQUIRE(value == 1);
}

TEST_CASE("a sequence has a picture and an object a frame") {
  const tests::ToolFolder folder;
  const tests::ToolResult result =
      folder.run(viewWith({"--frames", "8-10", "--out", "f%04d.png", "--out", "f%04d.exr", "--stats", "s.json"}));
  CAPTURE(result.err);
  REQUIRE(result.exitCode == 0);
  CHECK(result.err.find("frame") == std::string::npos); // the progress line is for terminals
  CHECK(folder.files() == std::vector<std::string>{"f0008.exr", "f0008.png", "f0009.exr", "f0009.png", "f0010.exr",
                                                   "f0010.png", "s.json", "triangle.gltf"});
  const nlohmann::json stats = nlohmann::json::parse(folder.read("s.json"));
  CHECK(stats.size() == 1);
  CHECK(stats.at("frames").size() == 3);
  CHECK(folder.read("f0008.png") == folder.read("f0010.png")); // nothing moves
}

TEST_CASE("without a file to write tyndall-render prints a summary, and notes on what it made up") {
  const tests::ToolFolder folder;
  const tests::ToolResult result = folder.run({"triangle.gltf", "--size", "16x9", "--shadow-size", "16"});
  CHECK(result.exitCode == 0);
  CHECK(result.out.find("triangle.gltf frame 0: 16x9") == 0);
  for (const char* made : {"note: scene has no camera", "note: scene has no light", "note: scene has no medium"})
    CHECK(result.err.find(made) != std::string::npos);
  CHECK(folder.files() == std::vector<std::string>{"triangle.gltf"});
}

TEST_CASE("--strict fails where a scene lacks light, camera or medium, and writes nothing") {
  const tests::ToolFolder folder;
  const Arguments picture = {"--size", "16x9",  "--shadow-size", "16",    "--strict",
                             "--out",  "a.png", "--stats",       "s.json"};
  const auto run = [&](Arguments arguments) {
    arguments.insert(arguments.end(), picture.begin(), picture.end());
    return folder.run(arguments);
  };
  const tests::ToolResult refused = run({"triangle.gltf"});
  CHECK(refused.exitCode == 1);
  for (const char* line : {"note: scene has no camera", "note: scene has no light", "note: scene has no medium",
                           "tyndall-render: triangle.gltf: --strict allows no notes"})
    CHECK(refused.err.find(line) != std::string::npos);
  CHECK(folder.files() == std::vector<std::string>{"triangle.gltf"});

  const std::string scene = std::string(TYNDALL_SCENES_DIR) + "/smoke.glb";
  const tests::ToolResult complete = run({scene});
  CAPTURE(complete.err);
  CHECK(complete.exitCode == 0);
  CHECK(complete.err.empty());
}

TEST_CASE("help and version answer on standard output") {
  const tests::ToolFolder folder;
  const tests::ToolResult help = folder.run({"--help"});
  CHECK(help.exitCode == 0);
  CHECK(help.err.empty());
  for (const char* option : {"--camera", "--eye", "--sun", "--size", "--supersample", "--profile", "--technique",
                             "--medium", "--shadow-size", "--avsm-size", "--avsm-nodes", "--no-avsm", "--frames",
                             "--repeat", "--context", "--out", "--stats", "1e30"})
    CHECK(help.out.find(option) != std::string::npos);
  const tests::ToolResult version = folder.run({"--version"});
  CHECK(version.exitCode == 0);
  CHECK(version.out.find("tyndall-render 0.") == 0);
}

TEST_CASE("programs are kept in the cache folder unless that is switched off, and the picture is the same") {
  const tests::ToolFolder folder;
  const std::string render = "XDG_CACHE_HOME=\"$PWD/caches\" tyndall-render triangle.gltf --sun 0.3,-1,-0.5 "
                             "--size 33x33 --shadow-size 64 --out ";
  const auto run = [&](const std::string& options) {
    const tests::ToolResult result = folder.shell(render + options);
    CAPTURE(result.err);
    REQUIRE(result.exitCode == 0);
  };
  run("without.exr --no-program-cache");
  CHECK_FALSE(std::filesystem::exists(folder.path("caches/tyndall")));
  run("first.exr");
  CHECK(std::filesystem::is_directory(folder.path("caches/tyndall/programs")));
  run("second.exr");
  CHECK(folder.read("first.exr") == folder.read("without.exr"));
  CHECK(folder.read("second.exr") == folder.read("without.exr"));
}

TEST_CASE("a cache folder that cannot be made is no reason to stop") {
  const tests::ToolFolder folder;
  folder.write("file", "");
  const tests::ToolResult result = folder.shell(
      "XDG_CACHE_HOME=\"$PWD/file\" tyndall-render triangle.gltf --sun 0.3,-1,-0.5 --size 33x33 --out a.png");
  CAPTURE(result.err);
  CHECK(result.exitCode == 0);
}
