// Technique exact on the sample scenes, against what the same maps imply and against the geometry itself.
#include "reference/Metrics.h"
#include "render/SceneAnswers.h"
#include "support/Catch.h"

TEST_CASE("exact equals map-exact on every sample scene at 4096 x 4096", "[slow]") {
  for (const std::string& scene : tests::sampleScenes()) {
    const tests::SceneAnswers answers = tests::renderScene(tests::sampleOptions(scene, 320, 180, 4096));
    const reference::ImageAnswer truth = reference::mapExact(answers.maps);
    const reference::ErrorMetrics error = reference::compare(answers.exact.inscatter, truth.inscatter);
    INFO(scene << ": " << error.text());
    CHECK(error.mean > 0);
    CHECK(error.rRmse <= 1e-3);
    CHECK(error.p99 <= 5e-3);
    CHECK(reference::compare(answers.exact.transmittance, truth.transmittance).max <= 1e-4);
  }
}

// A texel of a quarter the width brings nearly a quarter of the error where a few pixels, on whose edge of a leaf the
// rasteriser and the ray tracer disagree, do not count.
TEST_CASE("the error of exact against scene-exact falls as the map grows", "[slow]") {
  for (const std::string& scene : tests::sampleScenes()) {
    reference::Image truth;
    std::vector<reference::ErrorMetrics> errors;
    for (const int size : {256, 1024, 4096}) {
      const tests::SceneAnswers answers = tests::renderScene(tests::sampleOptions(scene, 160, 90, size));
      if (truth.rgb.empty()) truth = reference::SceneExact(answers.triangles).render(answers.view).inscatter;
      errors.push_back(reference::compare(answers.exact.inscatter, truth));
      if (errors.size() == 1) continue;
      const reference::ErrorMetrics &error = errors.back(), &last = errors[errors.size() - 2];
      INFO(scene << " at " << size << ": " << error.text());
      CHECK(error.rRmse < last.rRmse);
      CHECK(error.p99 <= 0.5 * last.p99);
    }
  }
}
