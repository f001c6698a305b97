// What is unphysical on purpose: Light::scatteringScale, Medium::dimsBackground.
#include "MediaRig.h"
#include "gl/ReadBack.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>

using namespace tyndall;
using namespace tests::media;

TEST_CASE("a light whose scattering is scaled adds so many times as much, and nothing at 0") {
  for (const Technique technique : kTechniques) {
    tests::SceneRig rig;
    rig.addLight(LightKind::Spot);
    rig.frame.medium = haze();
    rig.frame.settings.technique = technique;
    const reference::ImageAnswer once = rig.render();
    rig.frame.lights[0].scatteringScale = 4;
    const reference::ImageAnswer more = rig.render(), wanted = rig.reference();
    rig.frame.lights[0].scatteringScale = 0;
    const reference::ImageAnswer none = rig.render();
    CAPTURE(static_cast<int>(technique));
    CHECK(tests::difference(more.inscatter, sumOf(sumOf(once.inscatter, once.inscatter),
                                                  sumOf(once.inscatter, once.inscatter))) <= 1e-6);
    CHECK(more.transmittance.rgb == once.transmittance.rgb);
    if (technique == Technique::Exact) CHECK(reference::compare(more.inscatter, wanted.inscatter).rRmse <= 1e-3);
    CHECK(std::all_of(none.inscatter.rgb.begin(), none.inscatter.rgb.end(), [](double v) { return v == 0; }));
    const std::string name = technique == Technique::Exact ? "exact light 0" : "light 0";
    REQUIRE(passNamed(tests::testEffect().statistics(), name));
    CHECK(passNamed(tests::testEffect().statistics(), name)->skipped == "the light's scatteringScale is 0");
  }
}

TEST_CASE("a medium that dims nothing adds its light and leaves the picture behind, by every technique and way") {
  for (const Technique technique : kTechniques)
    for (const bool ambient : {false, true}) {
      tests::SceneRig rig;
      rig.addLight(LightKind::Point);
      rig.frame.medium = layered();
      rig.frame.settings.technique = technique;
      if (ambient) rig.frame.ambient = sky();
      const reference::ImageAnswer dimmed = rig.render();
      rig.frame.medium.dimsBackground = false;
      const reference::ImageAnswer bare = rig.render();
      CAPTURE(static_cast<int>(technique), ambient);
      CHECK(bare.inscatter.rgb == dimmed.inscatter.rgb);
      CHECK(std::all_of(bare.transmittance.rgb.begin(), bare.transmittance.rgb.end(), [](double v) { return v == 1; }));
      const auto width = rig.frame.viewport.width, height = rig.frame.viewport.height;
      const std::vector<float> back(static_cast<std::size_t>(4 * width * height), 0.25F);
      const host::GlTexture colour = rig.makeColour(GL_RGBA32F, back);
      rig.frame.output = {};
      REQUIRE(tests::testEffect().render(rig.frame));
      const reference::Image got(width, height, host::readColour(colour.name(), width, height, 3));
      reference::Image wanted = bare.inscatter;
      for (double& value : wanted.rgb)
        value += 0.25;
      CHECK(tests::difference(got, wanted) <= 1e-6);
    }
}
