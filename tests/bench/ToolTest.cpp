// tyndall-bench as a user meets it: one clear line for each wrong input, and references that survive a damaged cache.
#include "Plan.h"
#include "ReferenceCache.h"
#include "support/Catch.h"
#include "support/TemporaryFolder.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

struct ToolResult {
  int exitCode = -1;
  std::string output;
};

ToolResult runCommand(const std::string& command) {
  ToolResult result;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r"); // NOLINT(cert-env33-c): fixed commands
  REQUIRE(pipe);
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe))
    result.output += buffer.data();
  result.exitCode = WEXITSTATUS(pclose(pipe));
  return result;
}

ToolResult runTool(const std::string& arguments) {
  return runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " TYNDALL_BIN_DIR "/tyndall-bench " + arguments);
}

ToolResult runReport(const fs::path& json) {
  return runCommand("/usr/bin/python3 " TYNDALL_BENCH_DIR "/report.py " + json.string());
}

nlohmann::json readJson(const fs::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

} // namespace

TEST_CASE("wrong usage is a line that names the option and one on how to get help, exit code 2") {
  const std::array<std::array<const char*, 2>, 21> cases = {{
      {"--scenes cathedral", "--scenes cathedral: must be one of nave"},
      {"--scenes nave,,stage", "--scenes \"nave,,stage\": must be a list separated by single commas"},
      {"--scenes nave,nave", "--scenes nave,nave: names nave twice"},
      {"--techniques magic", "--techniques \"magic\": must be one of exact, high"},
      {"--techniques fixed:many", "--techniques \"fixed:many\": what follows fixed: must be whole numbers"},
      {"--techniques fixed", "--techniques \"fixed\": fixed needs"},
      {"--sizes 320", "--sizes 320: must be WIDTHxHEIGHT"},
      {"--sizes 0x10", "--sizes 0x10: must be WIDTHxHEIGHT"},
      {"--shadow-sizes 1e3", "--shadow-sizes 1e3: must be a whole number from 16"},
      {"--lights 17", "--lights 17: must be a whole number from 1 to 16"},
      {"--densities 0", "--densities 0: must be numbers above 0"},
      {"--densities nan", "--densities nan: must be numbers above 0"},
      {"--contexts vulkan", "--contexts vulkan: must be osmesa, egl or glfw"},
      {"--references truth", "--references truth: must be one of map, scene"},
      {"--runs 4", "--runs: Value 4 not in range"},
      {"--run-seconds 0", "--run-seconds: "},
      {"--series size", "--series size: must be one of curve, shadow"},
      {"--series shadow --scaling", " excludes --"},
      {"--out /no/such/folder", "--out: Directory does not exist: /no/such/folder"},
      {"--quick --all", " excludes --"},
      {"--plots", "--plots requires --out"},
  }};
  for (const auto& [arguments, message] : cases) {
    const ToolResult result = runTool(arguments);
    INFO(arguments << " -> " << result.output);
    CHECK(result.exitCode == 2);
    CHECK(result.output.find(message) != std::string::npos);
    CHECK(std::count(result.output.begin(), result.output.end(), '\n') == 2);
  }
}

TEST_CASE("a read-only output folder is refused") {
  if (geteuid() == 0) {
    WARN("skipped: root may write anywhere");
    return;
  }
  const tests::TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const ToolResult result = runTool("--out " + folder.path().string());
  CHECK(result.exitCode == 2);
  CHECK(result.output.find("must be a folder that can be written to") != std::string::npos);
}

TEST_CASE("a case that fails is reported and the rest go on") {
  const tests::TemporaryFolder folder;
  // A window needs a display.
  const ToolResult result =
      runTool("--sizes 32x32 --shadow-sizes 64 --techniques exact,fixed:16 --contexts glfw,osmesa --out " +
              folder.path().string());
  INFO(result.output);
  CHECK(result.exitCode == 1);
  CHECK(result.output.find("FAILED") != std::string::npos);
  CHECK(result.output.find("llvmpipe") != std::string::npos);
  CHECK(fs::exists(folder / "bench.csv"));
  CHECK(fs::exists(folder / "bench.json"));
}

TEST_CASE("every pass that ran has a floor, and only those, and visits are counted where there is a tree") {
  const tests::TemporaryFolder folder;
  const ToolResult result = runTool("--scenes nave,stage --sizes 96x64 --shadow-sizes 128 --floors --techniques "
                                    "exact,high,performance,tree:64,fixed:16 --out " +
                                    folder.path().string());
  INFO(result.output);
  REQUIRE(result.exitCode == 0);
  CHECK(result.output.find("high against its floors") != std::string::npos);
  const nlohmann::json bench = readJson(folder / "bench.json");
  for (const nlohmann::json& r : bench.at("results")) {
    CAPTURE(r.at("scene"), r.at("technique"));
    const bool isOurs = r.at("group") == "ours", hasTree = isOurs || r.at("family") == "tree";
    CHECK(r.contains("visits_per_ray") == hasTree);
    if (hasTree) CHECK(r.at("visits_estimate") > r.at("visits_per_ray"));
    REQUIRE(r.contains("floors") == (isOurs && r.at("scene") == "nave")); // of several lights there are none
    if (!r.contains("floors")) continue;
    std::vector<std::string> ran, floors;
    for (const nlohmann::json& pass : r.at("passes"))
      if (!pass.contains("skipped")) ran.push_back(pass.at("name"));
    for (const nlohmann::json& pass : r.at("floors").at("passes")) {
      floors.push_back("light 0 " + pass.at("name").get<std::string>());
      CHECK(pass.at("floor_ms") > 0);
      CHECK(pass.at("ms") > 0);
    }
    CHECK(floors == ran);
    CHECK(ran.size() >= 11);
  }
}

TEST_CASE("runs end when they took long; GL's own time is beside each, and what render() takes of the processor") {
  const tests::TemporaryFolder folder;
  const ToolResult result = runTool("--scenes stage --sizes 96x64 --shadow-sizes 128 --techniques exact,high --runs 20 "
                                    "--run-seconds 0.0001 --calls --out " +
                                    folder.path().string());
  INFO(result.output);
  REQUIRE(result.exitCode == 0);
  CHECK(result.output.find("the processor in render()") != std::string::npos);
  for (const nlohmann::json& r : readJson(folder / "bench.json").at("results")) {
    CAPTURE(r.at("technique"));
    CHECK(r.at("ms").at("runs").size() == 3);
    REQUIRE(r.at("gpu_ms").at("runs").size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(r.at("gpu_ms").at("runs")[i] > 0);
      CHECK(r.at("gpu_ms").at("runs")[i] <= r.at("ms").at("runs")[i]);
    }
    REQUIRE(r.contains("calls") == (r.at("group") == "ours"));
    if (!r.contains("calls")) continue;
    CHECK(r.at("calls").at("lights") == 4);
    for (const char* mode : {"restore", "leave"}) {
      CHECK(r.at("calls").at(mode).at("ms") > 0);
      CHECK(r.at("calls").at(mode).at("processor_ms") > 0);
    }
  }
}

TEST_CASE("the scaling series are measured in the context that is asked for") {
  const std::vector<bench::Setup> setups = bench::planScaling(host::ContextKind::Egl);
  CHECK(setups.size() > 10);
  for (const bench::Setup& setup : setups)
    CHECK(setup.context == host::ContextKind::Egl);
}

TEST_CASE("the report's tables hold the numbers of a run") {
  const tests::TemporaryFolder folder;
  REQUIRE(runTool("--sizes 96x64 --shadow-sizes 128 --floors --techniques exact,high,tree:64,fixed:16 --out " +
                  folder.path().string())
              .exitCode == 0);
  const ToolResult report = runReport(folder / "bench.json");
  INFO(report.output);
  REQUIRE(report.exitCode == 0);
  const nlohmann::json bench = readJson(folder / "bench.json");
  const auto holds = [&](const std::string& text) { return report.output.find(text) != std::string::npos; };
  CHECK(holds(bench.at("machine").at("processor")));
  CHECK(holds("Commit: " + bench.at("commit").get<std::string>()));
  const std::string setup = "nave 96x64 shadow 128 osmesa";
  const auto& results = bench.at("results");
  CHECK(holds("Driver: " + results[0].at("driver").get<std::string>()));
  const double exact = results[0].at("ms").at("median"), high = results[1].at("ms").at("median");
  const double error = results[1].at("errors").at("exact").at("rrmse");
  CHECK(holds(fmt::format("| {} | high | {:.3g} | {:.3g} | {:.3g}x | {:.3g} % |", setup, exact, high, exact / high,
                          100 * error)));
  CHECK(holds(fmt::format("| geometric mean: nave | high |  |  | {:.3g}x |", exact / high)));
  CHECK(holds(fmt::format("| {} | high | research | {:.3g} | {:.3g} % |", setup, high, 100 * error)));
  for (const auto& pass : results[1].at("floors").at("passes"))
    CHECK(holds(fmt::format("| {} | {:.3g} | {:.3g} |", pass.at("name").get<std::string>(), pass.at("ms").get<double>(),
                            pass.at("floor_ms").get<double>())));
}

TEST_CASE("the report computes means, ratios and the Pareto front") {
  const tests::TemporaryFolder folder;
  nlohmann::json bench = {{"machine", {{"processor", "P"}, {"cores", 1}, {"memory", 1 << 30}, {"system", "S"}}},
                          {"commit", "c"},
                          {"date", "d"}};
  const auto add = [&bench](const char* scene, const char* technique, double milliseconds, double rRmse) {
    bench["results"].push_back({{"series", "curve"},
                                {"scene", scene},
                                {"size", {8, 4}},
                                {"shadow_size", 16},
                                {"lights", 0},
                                {"density", 1.0},
                                {"context", "osmesa"},
                                {"driver", "D"},
                                {"technique", technique},
                                {"ms", {{"median", milliseconds}, {"runs", {milliseconds}}}},
                                {"errors", {{"exact", {{"rrmse", rRmse}, {"p99", 0.5}}}}},
                                {"bytes", 1 << 20}});
  };
  for (const auto& [scene, milliseconds] : {std::pair("nave", 20.0), {"forest", 80.0}, {"stage", 1.0}}) {
    add(scene, "exact", 160, 0);
    add(scene, "high", milliseconds, 0.125);
    add(scene, "fixed:16", 40, 0.0625);
  }
  bench["scaling"] = {{{"series", "shadow"},
                       {"technique", "high"},
                       {"range", 16.0},
                       {"first_ms", 2.0},
                       {"last_ms", 8.0},
                       {"exponent", 0.5}}};
  std::ofstream(folder / "bench.json") << bench;
  const ToolResult report = runReport(folder / "bench.json");
  INFO(report.output);
  REQUIRE(report.exitCode == 0);
  for (const char* row :
       {"| nave 8x4 shadow 16 osmesa | high | 160 | 20 | 8x | 12.5 % | 50 % | 1.0 |",
        "| geometric mean: nave, forest | high |  |  | 4x |", // 8x and 2x; stage is not among them
        "| nave 8x4 shadow 16 osmesa | high | yes |  |", "| forest 8x4 shadow 16 osmesa | high | no | fixed:16 |",
        "| shadow | high | 16x | 2 | 8 | 4x | 0.50 |"})
    CHECK(report.output.find(row) != std::string::npos);
}

TEST_CASE("a reference is kept, and made anew when its file is damaged or of another version") {
  const tests::TemporaryFolder folder;
  std::vector<std::string> said;
  const bench::ReferenceCache cache(folder.path(), [&said](const std::string& line) { said.push_back(line); });
  reference::MapScene scene;
  scene.width = scene.height = 4;
  scene.depth.assign(16, 0.5F);
  scene.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02, -1, 0, 0, -0.2, 0};
  scene.lights.emplace_back();
  scene.medium.constituents = {{{0.1F, 0.1F, 0.1F}, tyndall::Phase::Isotropic, 0}};
  const reference::Image first = cache.mapExact(scene);
  CHECK(first.rgb.front() > 0);
  REQUIRE(fs::exists(folder.path()));
  const fs::path file = fs::directory_iterator(folder.path())->path();
  const auto size = fs::file_size(file);

  CHECK(cache.mapExact(scene) == first);
  CHECK(said.empty());
  const auto damage = [&](std::streamoff at) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(at);
    stream.put('\x7f');
  };
  damage(static_cast<std::streamoff>(size) - 1);
  CHECK(cache.mapExact(scene) == first);
  REQUIRE(said.size() == 1);
  CHECK(said.back().find("is corrupt: it is made anew") != std::string::npos);
  damage(8);
  CHECK(cache.mapExact(scene) == first);
  REQUIRE(said.size() == 2);
  CHECK(said.back().find("is of version 127 instead of") != std::string::npos);
  fs::resize_file(file, size / 2);
  CHECK(cache.mapExact(scene) == first);
  CHECK(said.size() == 3);
  scene.medium.absorption = {1, 1, 1};
  CHECK(cache.mapExact(scene).rgb != first.rgb);
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}
