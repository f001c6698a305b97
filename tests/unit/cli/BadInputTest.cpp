#include "RunTool.h"
#include "support/Catch.h"

namespace {

using Arguments = std::vector<std::string>;

const std::vector<std::string> kUntouched = {"triangle.gltf"};

/// Two lines: what is wrong, in which all of these are mentioned, and how to get help. Nothing is left behind.
void checkUsageError(const Arguments& arguments, const std::vector<std::string>& mentions) {
  const tests::ToolFolder folder;
  const tests::ToolResult result = folder.run(arguments);
  CAPTURE(arguments, result.out, result.err);
  CHECK(result.exitCode == 2);
  CHECK(result.out.empty());
  const std::vector<std::string> lines = result.errLines();
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].rfind("tyndall-render: ", 0) == 0);
  for (const std::string& mention : mentions)
    CHECK_THAT(lines[0], Catch::Contains(mention));
  CHECK(lines[1].rfind("usage: tyndall-render ", 0) == 0);
  CHECK(folder.files() == kUntouched);
}

/// One line that mentions file and cause.
void checkFailure(const tests::ToolFolder& folder, const Arguments& arguments, const std::string& file,
                  const std::string& cause) {
  const std::vector<std::string> before = folder.files();
  const tests::ToolResult result = folder.run(arguments);
  CAPTURE(arguments, result.out, result.err);
  CHECK(result.exitCode == 1);
  CHECK(result.out.empty());
  std::vector<std::string> lines;
  for (const std::string& line : result.errLines())
    if (line.rfind("note: ", 0) != 0) lines.push_back(line);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].rfind("tyndall-render: ", 0) == 0);
  CHECK(lines[0].find(file) != std::string::npos);
  CHECK(lines[0].find(cause) != std::string::npos);
  CHECK(folder.files() == before);
}

} // namespace

TEST_CASE("tyndall-render refuses wrong usage with exit code 2") {
  checkUsageError({}, {"SCENE"});
  checkUsageError({"triangle.gltf", "--no-such-option"}, {"--no-such-option"});
  checkUsageError({"triangle.gltf", "second.gltf"}, {"second.gltf"});
  checkUsageError({"triangle.gltf", "--size"}, {"--size"});
  checkUsageError({"triangle.gltf", "--size", "10x10", "--size", "20x20"}, {"--size"});
  checkUsageError({"triangle.gltf", "--medium", ""}, {"--medium"});
  checkUsageError({""}, {"SCENE"});
  checkUsageError({"triangle.gltf", "--profile", "fast"},
                  {"--profile: fast", "not in {performance,balanced,high,reference}"});
  checkUsageError({"triangle.gltf", "--technique", "radial-blur"},
                  {"--technique: radial-blur", "not in {exact,tree,epipolar,lowrank}"});
  checkUsageError({"triangle.gltf", "--row-step", "9"}, {"--row-step: ", "9 not in range", "1", "8"});
  checkUsageError({"triangle.gltf", "--tree", "yes"}, {"--tree: yes not in {on,off}"});
  checkUsageError({"triangle.gltf", "--break-threshold", "0"}, {"--break-threshold: 0 must be above 0"});
  checkUsageError({"triangle.gltf", "--bend-threshold", "nan"}, {"--bend-threshold: nan is not a finite number"});
  checkUsageError({"triangle.gltf", "--least-weight", "1.5"}, {"--least-weight: ", "1.5 not in range", "0", "1"});
  checkUsageError({"triangle.gltf", "--cascade-fade", "0.6"}, {"--cascade-fade: ", "0.6 not in range", "0.5"});
  checkUsageError({"triangle.gltf", "--average-threshold", "2"}, {"--average-threshold: ", "2 not in range", "1"});
  checkUsageError({"triangle.gltf", "--spread-threshold", "0"}, {"--spread-threshold: 0 must be above 0"});
  checkUsageError({"triangle.gltf", "--view", "wireframe"}, {"--view: wireframe not in {composite,slices,"});
  checkUsageError({"triangle.gltf", "--filter", "cubic"}, {"--filter: cubic", "{nearest,bilinear}"});
  checkUsageError({"triangle.gltf", "--context", "vulkan"}, {"--context: vulkan", "{osmesa,egl,glfw}"});
  checkUsageError({"triangle.gltf", "--no-reuse", "--detect-changes"}, {"excludes", "--no-reuse", "--detect-changes"});
  // Names, not the numbers that stand for them inside.
  checkUsageError({"triangle.gltf", "--filter", "0"}, {"--filter: 0"});
  checkUsageError({"triangle.gltf", "--view", "3"}, {"--view: 3"});
}

TEST_CASE("every tool refuses wrong usage with two lines and exit code 2") {
  const tests::ToolFolder folder;
  const std::pair<std::string, std::string> cases[] = {
      {"tyndall-make-scenes", "OUTDIR"},
      {"tyndall-make-scenes . cathedral", "cathedral not in {cage,"},
      {"tyndall-make-scenes '' smoke", "OUTDIR"},
      {"tyndall-sequence triangle.gltf", "--frames"},
      {"tyndall-bench --runs 0x10", "--runs: 0x10"},
      {"tyndall-avsm-bench --size 7", "--size: "},
      {"tyndall-avsm-bench --scenes fog", "--scenes fog: must be one of"},
      {"tyndall-accuracy --all", "--all"},
      {"tyndall-low-rank ''", "SCENE"},
      {"tyndall-look-up ''", "SCENE"},
      {"tyndall-shaders --all", "DIR"}}; // no folder of that name
  for (const auto& [command, mention] : cases) {
    const tests::ToolResult result = folder.shell(command);
    CAPTURE(command, result.out, result.err);
    CHECK(result.exitCode == 2);
    CHECK(result.out.empty());
    REQUIRE(result.errLines().size() == 2);
    CHECK_THAT(result.errLines()[0], Catch::StartsWith(command.substr(0, command.find(' ')) + ": "));
    CHECK_THAT(result.errLines()[0], Catch::Contains(mention));
  }
  CHECK(folder.files() == kUntouched);
}

TEST_CASE("tyndall-render takes only whole numbers within their ranges") {
  for (const std::string size : {"0x10", "10x0", "16385x10", "10x16385", "-1x5", "10", "x", "10x", "10x10x10", "1ax2",
                                 "1.5x2", " 10x10", "99999999999x1", "nan"})
    checkUsageError({"triangle.gltf", "--size", size}, {"--size " + size});
  for (const std::string size :
       {"0", "16385", "1.5", "1x", "1,2", "-4", "nan", "0x10", "0b11", "1'000", "1_000", "true"})
    checkUsageError({"triangle.gltf", "--shadow-size", size}, {"--shadow-size: ", size});
  for (const std::string count : {"0", "5", "two"})
    checkUsageError({"triangle.gltf", "--cascades", count}, {"--cascades: ", count});
  for (const std::string size : {"0", "4097", "1.5"})
    checkUsageError({"triangle.gltf", "--avsm-size", size}, {"--avsm-size: ", size});
  for (const std::string nodes : {"0", "6", "20"})
    checkUsageError({"triangle.gltf", "--avsm-nodes", nodes}, {"--avsm-nodes: ", nodes});
  for (const std::string count : {"0", "9", "1.5", "-2"})
    checkUsageError({"triangle.gltf", "--supersample", count}, {"--supersample: ", count});
  checkUsageError({"triangle.gltf", "--low-rank-terms", "010"}, {"--low-rank-terms: ", "10 not in range"}); // not eight
  checkUsageError({"triangle.gltf", "--size", "4097x10", "--supersample", "4"}, {"--supersample 4"});
  for (const std::string option : {"--reuse-mask", "--fixup-mask", "--compositing"})
    for (const std::string name : {"", "Stencil", "1", "none"})
      checkUsageError({"triangle.gltf", option, name}, {option, name});
  for (const std::string repeat : {"0", "-1", "3x", "10001"})
    checkUsageError({"triangle.gltf", "--repeat", repeat}, {"--repeat: ", repeat});
  for (const std::string milliseconds : {"nan", "-1", "10001", "long"})
    checkUsageError({"triangle.gltf", "--band-ms", milliseconds}, {"--band-ms: ", milliseconds});
  for (const std::string exposure : {"nan", "inf", "1e400", "101", "bright"})
    checkUsageError({"triangle.gltf", "--exposure", exposure}, {"--exposure: ", exposure});
  for (const std::string frames : {"3-1", "a-b", "5", "1-2-3", "-1-3", "0-1000000", "0 - 3"})
    checkUsageError({"triangle.gltf", "--out", "a%04d.png", "--frames", frames}, {"--frames " + frames});
}

TEST_CASE("tyndall-render refuses a view or a sun that cannot be") {
  const Arguments view = {"triangle.gltf", "--eye", "0,0,5", "--target", "0,0,0"};
  const auto with = [&view](const Arguments& more) {
    Arguments all = view;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const std::string fov : {"0", "180", "-10", "nan", "inf", "1x", "1,2"})
    checkUsageError(with({"--fov", fov}), {"--fov: ", fov});
  checkUsageError(with({"--camera", "0"}), {"--camera excludes --eye"});
  checkUsageError({"triangle.gltf", "--fov", "50"}, {"--fov requires --eye"});
  checkUsageError({"triangle.gltf", "--eye", "0,0,5"}, {"--eye requires --target"});
  checkUsageError({"triangle.gltf", "--target", "0,0,5"}, {"--target requires --eye"});
  checkUsageError({"triangle.gltf", "--eye", "1,1,1", "--target", "1,1,1"}, {"--target 1,1,1"});
  for (const std::string eye : {"1,2", "1,2,3,4", "1,2,x", "1,2,", "nan,0,0", "1 ,2,3", "inf,0,0"})
    checkUsageError({"triangle.gltf", "--target", "0,0,0", "--eye", eye}, {"--eye " + eye});
  for (const std::string camera : {"-1", "1x", "1.0", "one"})
    checkUsageError({"triangle.gltf", "--camera", camera}, {"--camera: ", camera});
  for (const std::string sun :
       {"0,0,0", "1,2", "0,-1,0,1", "nan,-1,0", "0,-1,0,1,-1,1", "0,-1,0,1,1,1,1", "1e300,1e300,0"})
    checkUsageError({"triangle.gltf", "--sun", sun}, {"--sun " + sun});
}

TEST_CASE("tyndall-render refuses names of files that cannot be meant") {
  checkUsageError({"triangle.gltf", "--out", "a.jpg"}, {"--out a.jpg"});
  checkUsageError({"triangle.gltf", "--out", "png"}, {"--out png"});
  checkUsageError({"triangle.gltf", "--out", "a.png", "--out", "b.png", "--out", "c.png"}, {"--out c.png"});
  checkUsageError({"triangle.gltf", "--out", "a.png", "--out", "a.png"}, {"--out a.png"});
  checkUsageError({"triangle.gltf", "--out", "a.png", "--stats", "a.png"}, {"--stats a.png"});
  checkUsageError({"triangle.gltf", "--out", "a%04d.png"}, {"--frames"});
  checkUsageError({"triangle.gltf", "--out", "a.png", "--frames", "0-3"}, {"%04d"});
}

TEST_CASE("tyndall-render names a scene that it cannot read") {
  const tests::ToolFolder folder;
  checkFailure(folder, {"missing.glb"}, "missing.glb", ": ");
  checkFailure(folder, {"."}, ".", ": ");
  folder.write("empty.glb", "");
  checkFailure(folder, {"empty.glb"}, "empty.glb", ": ");
  folder.write("garbage.gltf", "{\"asset\": ");
  checkFailure(folder, {"garbage.gltf"}, "garbage.gltf", ": ");
  folder.write("cut.gltf", folder.read("triangle.gltf").substr(0, 300));
  checkFailure(folder, {"cut.gltf"}, "cut.gltf", ": ");
  checkFailure(folder, {"two\nlines.glb"}, "two", ": ");
  checkFailure(folder, {"triangle.gltf", "--camera", "3"}, "camera 3", "no camera");
}

TEST_CASE("tyndall-render names a medium that it cannot use") {
  const tests::ToolFolder folder;
  checkFailure(folder, {"triangle.gltf", "--medium", "missing.json"}, "missing.json", ": ");
  const std::pair<const char*, const char*> cases[] = {
      {R"({"fog": 1})", "fog"},
      {R"({"absorption": [-1, 0, 0]})", "absorption"},
      {R"({"absorption": [1e999, 0, 0]})", ""},
      {R"({"absorption": [NaN, 0, 0]})", ""},
      {R"({"absorption": [1, 0]})", "absorption"},
      {R"({"constituents": [{"scattering": [1, 1, 1], "phase": "mie"}]})", "mie"},
      {R"({"constituents": [{"scattering": [1, 1, 1], "phase": "henyey-greenstein", "g": 1}]})", "g"},
      {"[]", ""},
      {"", ""}};
  for (const auto& [text, cause] : cases) {
    CAPTURE(text);
    folder.write("medium.json", text);
    checkFailure(folder, {"triangle.gltf", "--medium", "medium.json"}, "medium.json", cause);
  }
}

TEST_CASE("tyndall-render finds out before it renders that a file cannot be written") {
  const tests::ToolFolder folder;
  std::filesystem::create_directory(folder.path("folder.png"));
  for (const std::string name : {"missing/a.png", "folder.png", "/proc/a.png"}) {
    // The scene is missing, too: that the picture is named shows that it was looked at first.
    checkFailure(folder, {"missing.glb", "--out", name}, name, ": ");
    checkFailure(folder, {"triangle.gltf", "--size", "4x4", "--out", "good.exr", "--out", name}, name, ": ");
  }
  checkFailure(folder, {"missing.glb", "--stats", "missing/s.json"}, "missing/s.json", ": ");
  checkFailure(folder, {"missing.glb", "--frames", "7-9", "--out", "missing/%04d.png"}, "missing/0007.png", ": ");
}
