// Slices that are left out for an error target (settings.errorTarget).
#include "ShaftRig.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

using namespace tyndall;
using tests::testEffect;

namespace {

constexpr int kWidth = 192, kHeight = 128, kSlices = 320;

// A light of a kind; with `aside` it is not in the image, so that slices have two ends along its border.
tests::ShaftRig rigOf(LightKind kind, bool aside = false, int cascades = 1) {
  tests::ShaftRig rig(kWidth, kHeight);
  if (aside)
    rig.look(tests::toMat4(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(0, 1, 0)) *
                           glm::translate(glm::dmat4(1), glm::dvec3(0, -2, 0))));
  Light light = tests::shaftLight(kind);
  if (kind == LightKind::Directional) light.shadow.views = tests::shadowViews(light, cascades);
  rig.addLight(light, 256);
  rig.scene.frame.settings.slices = kSlices;
  rig.scene.frame.settings.samples = 128;
  return rig;
}

reference::Image pictureWith(tests::ShaftRig& rig, float target) {
  rig.scene.frame.settings.errorTarget = target;
  return rig.picture(Technique::Epipolar);
}

double apart(const reference::Image& image, const reference::Image& from) {
  return tests::errorWhere(image, from, [](int, int) { return true; });
}

std::uint64_t drawnSlices() { return testEffect().statistics().drawnSlices; }

} // namespace

TEST_CASE("an error target leaves slices out, and of those that are left comes a picture within it") {
  for (const bool aside : {false, true})
    for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
      CAPTURE(aside, static_cast<int>(kind));
      tests::ShaftRig rig = rigOf(kind, aside);
      const reference::Image all = pictureWith(rig, 0);
      const std::uint64_t allSlices = drawnSlices();
      std::uint64_t before = allSlices + 32; // rounded to blocks
      for (const float target : {0.01F, 0.03F, 0.1F, 0.3F}) {
        const double error = apart(pictureWith(rig, target), all);
        const Statistics statistics = testEffect().statistics();
        CAPTURE(target, error, allSlices, statistics.drawnSlices, statistics.errorEstimate, statistics.shareOverTarget);
        CHECK(statistics.drawnSlices <= before);
        CHECK(statistics.drawnSlices >= allSlices / 8);
        CHECK(error < target);
        CHECK(statistics.errorEstimate > 0);
        before = statistics.drawnSlices;
      }
      CHECK(before < allSlices / 2);
    }
}

TEST_CASE("a target that cannot be reached brings all slices, and says that it is missed") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
    tests::ShaftRig rig = rigOf(kind);
    const reference::Image all = pictureWith(rig, 0), within = pictureWith(rig, 1e-6F);
    const Statistics statistics = testEffect().statistics();
    CAPTURE(static_cast<int>(kind), rig.error(all).rRmse, rig.error(within).rRmse);
    CHECK(statistics.drawnSlices >= kSlices * 3 / 4); // where nothing is lit there is no error
    CHECK(statistics.drawnSlices <= kSlices);
    CHECK(statistics.shareOverTarget > 0.5);
    CHECK(statistics.errorEstimate > 1e-6);
    CHECK(rig.error(within).rRmse <= 1.25 * rig.error(all).rRmse); // a preview of so few samples tells little
  }
}

// The least targets that are allowed want more slices than there is room for, whatever is tried in their place.
TEST_CASE("however small a target is no more slices are drawn than there is room for") {
  tests::ShaftRig rig = rigOf(LightKind::Directional);
  rig.scene.frame.settings.slices = 64;
  const double most = 2 * rig.error(pictureWith(rig, 0)).rRmse;
  for (const float target : {1e-3F, 1e-9F, 1e-20F, 1e-38F}) {
    const double error = rig.error(pictureWith(rig, target)).rRmse;
    CAPTURE(target, error, drawnSlices());
    CHECK(drawnSlices() <= 64);
    CHECK(error < most);
  }
}

TEST_CASE("what an error target leaves out is the same in any unit of light") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot}) {
    tests::ShaftRig rig = rigOf(kind);
    pictureWith(rig, 0.03F);
    const Statistics before = testEffect().statistics();
    for (const float scale : {1e-3F, 1e4F}) {
      Light& light = rig.scene.frame.lights[0];
      const Rgb colour = light.colour;
      for (float& channel : light.colour)
        channel *= scale;
      pictureWith(rig, 0.03F);
      const Statistics statistics = testEffect().statistics();
      CAPTURE(static_cast<int>(kind), scale);
      CHECK(statistics.drawnSlices == before.drawnSlices);
      CHECK(static_cast<double>(statistics.marchedSamples) ==
            Approx(static_cast<double>(before.marchedSamples)).epsilon(0.001));
      light.colour = colour;
    }
  }
}

TEST_CASE("of light without shadows few slices are drawn") {
  tests::ShaftRig rig = rigOf(LightKind::Directional);
  rig.scene.frame.lights[0].shadow = {};
  const reference::Image picture = pictureWith(rig, 0.01F);
  CHECK(drawnSlices() <= kSlices / 4 + 8); // and those at the border's end
  CHECK(apart(picture, rig.picture(Technique::Exact)) < 0.01);
}

TEST_CASE("cascades and a filter, glass and curves of smoke may have an error target") {
  for (const bool glass : {false, true})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      tests::ShaftRig rig(kWidth, kHeight);
      Light sun = tests::shaftLight(LightKind::Directional);
      sun.shadow.views = tests::shadowViews(sun, 3);
      rig.addLight(sun, 256, glass);
      rig.addLight(tests::shaftLight(LightKind::Spot), 256, glass);
      Settings& settings = rig.scene.frame.settings;
      settings.slices = kSlices;
      settings.shadowFilter = filter;
      const reference::Image all = pictureWith(rig, 0);
      const std::uint64_t allSlices = drawnSlices();
      const double error = apart(pictureWith(rig, 0.05F), all);
      CAPTURE(glass, static_cast<int>(filter), error, allSlices, drawnSlices());
      CHECK(drawnSlices() < allSlices * 3 / 4);
      CHECK(error < 0.05);
    }
}

TEST_CASE("where all slices are drawn whatever the target, the picture is the one without") {
  struct Rule {
    std::string name;
    void (*enter)(Frame&);
  };
  const Rule rules[] = {{"a spread threshold", [](Frame& f) { f.settings.spreadThreshold = 0.05F; }},
                        {"temporal reuse", [](Frame& f) { f.reuse.changes = Changes::Detect; }},
                        {"31 slices", [](Frame& f) { f.settings.slices = 31; }}};
  for (const Rule& rule : rules) {
    CAPTURE(rule.name);
    tests::ShaftRig rig = rigOf(LightKind::Directional);
    rule.enter(rig.scene.frame);
    const reference::Image all = pictureWith(rig, 0);
    const std::uint64_t slices = drawnSlices();
    const reference::Image same = pictureWith(rig, 0.1F);
    const Statistics statistics = testEffect().statistics();
    CHECK(statistics.drawnSlices == slices);
    CHECK(statistics.errorEstimate == 0);
    CHECK(statistics.shareOverTarget == 0);
    CHECK(same.rgb == all.rgb);
  }
}

TEST_CASE("other techniques do not know of an error target") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::LowRank}) {
    tests::ShaftRig rig = rigOf(LightKind::Directional);
    const reference::Image without = rig.picture(technique);
    rig.scene.frame.settings.errorTarget = 0.1F;
    CAPTURE(static_cast<int>(technique));
    CHECK(rig.picture(technique).rgb == without.rgb);
  }
}

// Slices come and go in blocks as the light moves: a picture's error stays what was asked for.
TEST_CASE("a turning camera sees no picture that is farther off than its error target", "[sweep]") {
  tests::ShaftRig rig = rigOf(LightKind::Directional);
  constexpr float kTarget = 0.05F;
  std::uint64_t fewest = kSlices, most = 0;
  for (int frame = 0; frame < 120; ++frame) {
    rig.look(tests::toMat4(glm::rotate(glm::dmat4(1), glm::radians(0.5 * frame - 20), glm::dvec3(0, 1, 0)) *
                           glm::translate(glm::dmat4(1), glm::dvec3(0, -2, 0))));
    const reference::Image all = pictureWith(rig, 0), within = pictureWith(rig, kTarget);
    CAPTURE(frame, drawnSlices());
    CHECK(apart(within, all) < kTarget);
    fewest = std::min(fewest, drawnSlices());
    most = std::max(most, drawnSlices());
  }
  CHECK(fewest < most); // or none came and went
}
