// The sample scenes under light of any unit: scaled by k, the inscatter is k times what it was.
#include "reference/Metrics.h"
#include "render/SceneAnswers.h"
#include "support/Catch.h"

#include <render/RenderFrame.h>

using namespace tyndall;

namespace {

constexpr int kWidth = 96, kHeight = 54;

// Inscatter of a frame whose lights are k times as bright, divided by k.
reference::Image inscatterAt(Effect& effect, Frame frame, float k) {
  for (Light& light : frame.lights)
    for (float& channel : light.colour)
      channel *= k;
  reference::Image image = tests::inscatterOf(effect, frame);
  for (double& value : image.rgb)
    value /= k;
  return image;
}

} // namespace

TEST_CASE("inscatter of every sample scene scales with its lights, in every technique") {
  for (const std::string& scene : tests::sampleScenes()) {
    render::FrameRenderer renderer(tests::sampleOptions(scene, kWidth, kHeight, 512));
    renderer.draw(0);
    const CreateResult created = Effect::create({renderer.context().loader(), PassTiming::Off});
    REQUIRE(created.effect);
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
      Frame frame = renderer.frame();
      frame.settings = settingsOf(Profile::High);
      frame.settings.technique = technique;
      const reference::Image one = inscatterAt(*created.effect, frame, 1);
      for (const float k : {1e-8F, 1e-6F, 1e-3F, 1e4F, 1e7F}) {
        const reference::ErrorMetrics error = reference::compare(inscatterAt(*created.effect, frame, k), one);
        CAPTURE(scene, static_cast<int>(technique), k, error.text());
        CHECK(error.mean > 0);
        CHECK(error.rRmse <= 1e-5);
      }
    }
  }
}
