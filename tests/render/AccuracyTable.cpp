// Prints the README's accuracy table: exact against map-exact and scene-exact, every sample scene, three map sizes.
// tyndall-accuracy [SCENE…]
#include "reference/Metrics.h"
#include "render/SceneAnswers.h"

#include <fmt/format.h>
#include <render/CommandLine.h>
#include <scene/Tool.h>

namespace {

/// Mesa's software rasteriser makes no texture above 1 GiB: six faces of 32 bits end at 6688².
int largestMap(const std::string& scene) { return scene == "cage" ? 6144 : 8192; }

void printRows(const std::string& scene) {
  reference::Image truth;
  for (const int size : {1024, 4096, largestMap(scene)}) {
    const tests::SceneAnswers answers = tests::renderScene(tests::sampleOptions(scene, 320, 180, size));
    if (truth.rgb.empty()) truth = reference::SceneExact(answers.triangles).render(answers.view).inscatter;
    const reference::ErrorMetrics map =
        reference::compare(answers.exact.inscatter, reference::mapExact(answers.maps).inscatter);
    const reference::ErrorMetrics geometry = reference::compare(answers.exact.inscatter, truth);
    host::print(fmt::format("| {} | {}² | {:.2g} % | {:.2g} % | {:.2g} % | {:.2g} % |\n", scene, size, 100 * map.rRmse,
                            100 * map.p99, 100 * geometry.rRmse, 100 * geometry.p99));
  }
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-accuracy", [&] {
    const std::vector<std::string> scenes =
        tests::parseSceneNames("Prints the accuracy table: exact against map-exact and scene-exact.", argc, argv);
    host::print(
        "| scene | shadow map | rRMSE, map-exact | p99 | rRMSE, scene-exact | p99 |\n|---|---|---|---|---|---|\n");
    for (const std::string& scene : scenes)
      printRows(scene);
    return 0;
  });
}
