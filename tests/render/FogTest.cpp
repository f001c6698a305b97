// Banks of fog whose curves and shadows change at every texel, along rays that nearly follow the light.
#include "reference/Metrics.h"
#include "render/SceneAnswers.h"
#include "support/Catch.h"

#include <render/RenderFrame.h>

using namespace tyndall;

namespace {

constexpr int kWidth = 320, kHeight = 180;

reference::Image inscatterBy(Effect& effect, Frame frame, Technique technique) {
  frame.settings = settingsOf(Profile::High);
  frame.settings.technique = technique;
  return tests::inscatterOf(effect, frame);
}

} // namespace

// Mesa's llvmpipe ends the loops of a shader after 65,535 turns in all. Pixels below the roofs' shadows had more, and
// half of their light.
TEST_CASE("exact loses no light where a ray of the harbour has most to look at", "[slow]") {
  render::FrameRenderer renderer(tests::sampleOptions("harbour", kWidth, kHeight, 4096));
  renderer.draw(0);
  const CreateResult created = Effect::create({renderer.context().loader(), PassTiming::Off});
  REQUIRE(created.effect);
  const reference::Image exact = inscatterBy(*created.effect, renderer.frame(), Technique::Exact);
  const reference::Image tree = inscatterBy(*created.effect, renderer.frame(), Technique::Tree);
  const reference::ErrorMetrics error = reference::compare(tree, exact);
  INFO(error.text());
  CHECK(error.mean > 0);
  CHECK(error.rRmse <= 0.003);
  CHECK(error.max <= 0.4);
}
