// tyndall-render against the independent truth of ../shared/truth, judged by the comparison that comes with it.
#include "support/Catch.h"
#include "support/TemporaryFolder.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string outputOf(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c): fixed commands
  REQUIRE(pipe);
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe))
    output += buffer.data();
  pclose(pipe);
  return output;
}

// The comparison of the scene as a profile renders it with its truth.
nlohmann::json compareWithTruth(const fs::path& truth, const std::string& name, const std::string& profile) {
  const tests::TemporaryFolder scratch;
  const std::string scene = "analytic_" + name;
  const fs::path image = scratch / (scene + ".exr");
  // The slit's slab of light runs 600 m along the view: one map of 4096 texels would spend 15 cm on each.
  const std::string cascades = name == "slit" ? " --cascades 4" : "";
  const std::string render =
      std::string(TYNDALL_BIN_DIR) + "/tyndall-render " + (truth / "scenes" / (scene + ".glb")).string() +
      " --medium " + (truth / "scenes" / (scene + ".medium.json")).string() +
      " --size 320x180 --shadow-size 4096 --profile " + profile + cascades + " --out " + image.string() + " 2>&1";
  INFO(outputOf(render));
  const std::string compare = "/usr/bin/python3 " + (truth / "compare.py").string() + " " + image.string() + " " +
                              (truth / "images" / (scene + "_320x180.exr")).string() + " --layer inscatter --json";
  const std::string answer = outputOf(compare);
  INFO(scene << ", " << profile << ": " << answer);
  const nlohmann::json json = nlohmann::json::parse(answer, nullptr, false);
  REQUIRE(json.is_object());
  return json;
}

} // namespace

TEST_CASE("exact agrees with the independent truth, and high does as well") {
  const fs::path truth = fs::path(TYNDALL_SHARED_DIR) / "truth";
  if (!fs::exists(truth / "compare.py")) {
    WARN("skipped: " << truth.string() << " is absent");
    return;
  }
  for (const std::string name : {"dir_open", "point_open", "spot_open", "slit", "columns", "boxes"}) {
    CAPTURE(name);
    const nlohmann::json exact = compareWithTruth(truth, name, "reference"),
                         high = compareWithTruth(truth, name, "high");
    CAPTURE(exact.dump(), high.dump());
    CHECK(exact["scale"].get<double>() == Approx(1).margin(0.002));
    CHECK(exact["flat_rmse"].get<double>() <= 0.01);
    CHECK(high["scale"].get<double>() == Approx(1).margin(0.002));
    // Where no edge is in the way exact errs by 0.01 % or so; its interpolation cannot follow that far.
    CHECK(high["trim_rmse"].get<double>() <= std::max(1.1 * exact["trim_rmse"].get<double>(), 0.004));
  }
}
