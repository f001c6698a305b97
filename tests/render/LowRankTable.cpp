// Prints how far technique lowrank is from tree, which integrates the same spans in closed form, by the number of its
// terms: every sample scene with an isotropic medium of its own density. tyndall-low-rank [SCENE…]
#include "reference/Metrics.h"
#include "render/SceneAnswers.h"
#include "support/TemporaryFolder.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <render/CommandLine.h>
#include <scene/FileIo.h>
#include <scene/Tool.h>

namespace {

constexpr int kTerms = 8;

/// Writes the scene's medium, all scattering isotropic.
void writeIsotropic(const tyndall::Medium& medium, const std::filesystem::path& file) {
  tyndall::Rgb sum{};
  for (const tyndall::Constituent& constituent : medium.constituents)
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += constituent.scattering[c];
  const nlohmann::json json = {{"constituents", {{{"scattering", sum}, {"phase", "isotropic"}}}},
                               {"absorption", medium.absorption}};
  host::writeText(file, json.dump());
}

void printRow(const std::string& scene) {
  render::Options options = tests::sampleOptions(scene, 320, 180, 1024);
  const tests::TemporaryFolder folder;
  writeIsotropic(tests::renderScene(options).view.medium, folder / "medium.json");
  options.mediumFile = folder / "medium.json";
  options.settings.technique = tyndall::Technique::Tree;
  const reference::Image truth = tests::renderScene(options).exact.inscatter;
  host::print("| " + scene + " |");
  options.settings.technique = tyndall::Technique::LowRank;
  for (int terms = 1; terms <= kTerms; ++terms) {
    options.settings.lowRankTerms = terms;
    const reference::ErrorMetrics error = reference::compare(tests::renderScene(options).exact.inscatter, truth);
    host::print(fmt::format(" {:.2g} % |", 100 * error.rRmse));
  }
  host::print("\n");
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-low-rank", [&] {
    const std::vector<std::string> scenes = tests::parseSceneNames(
        "Prints how far technique lowrank is from tree, by the number of its terms.", argc, argv);
    host::print("| rRMSE against tree |");
    for (int terms = 1; terms <= kTerms; ++terms)
      host::print(fmt::format(" N = {} |", terms));
    host::print("\n|---|");
    for (int terms = 1; terms <= kTerms; ++terms)
      host::print("---|");
    host::print("\n");
    for (const std::string& scene : scenes)
      printRow(scene);
    return 0;
  });
}
