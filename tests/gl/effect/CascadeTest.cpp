// Cascades that fade into one another: each point's weights add up to one, by every technique. (ExactTest has the fade
// against map-exact.)
#include "ShaftRig.h"
#include "support/Catch.h"

using namespace tyndall;

namespace {

// A sun through cascades that are lit throughout.
void makeRig(tests::ShaftRig& rig, int cascades) {
  Light light = tests::shaftLight(LightKind::Directional);
  light.shadow.views = tests::shadowViews(light, cascades);
  rig.addLight(light, 64);
  reference::ShadowImage image = rig.scene.shadow(0);
  image.depth.assign(image.depth.size(), 1.0F);
  rig.scene.setShadow(0, image);
  rig.changed();
}

} // namespace

TEST_CASE("a fade between cascades changes nothing where they agree", "[sweep]") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    tests::ShaftRig rig(64, 48);
    makeRig(rig, 3);
    const reference::Image seam = rig.picture(technique);
    rig.scene.frame.lights[0].cascadeFade = 0.3;
    const reference::Image fade = rig.picture(technique);
    CHECK(tests::difference(seam, fade) <= 2e-6);
  }
}

TEST_CASE("the last cascade does not fade: there is none to fade into", "[sweep]") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    tests::ShaftRig rig = tests::smallShaftRig(technique);
    const reference::Image hard = rig.picture(technique);
    rig.scene.frame.lights[0].cascadeFade = 0.4;
    CHECK(rig.picture(technique) == hard);
  }
}

TEST_CASE("cascades that fade look alike by every technique", "[sweep]") {
  tests::ShaftRig rig(96, 64);
  Light light = tests::shaftLight(LightKind::Directional);
  light.shadow.views = tests::shadowViews(light, 4);
  light.cascadeFade = 0.2;
  rig.addLight(light, 256);
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    const tests::ShaftError error = rig.error(rig.picture(technique));
    CAPTURE(error.displaced);
    CHECK(error.rRmse <= 1.5 * error.displaced);
  }
}
