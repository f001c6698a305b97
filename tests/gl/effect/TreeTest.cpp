// Technique tree on every kind of shadow map against exact.
#include "ShaftRig.h"

#include <catch2/catch.hpp>

using namespace tyndall;

namespace {

struct Case {
  std::string name;
  Light light;
};

// A sun through 1 to 4 cascades.
std::vector<Case> suns() {
  std::vector<Case> cases;
  for (int cascades = 1; cascades <= 4; ++cascades) {
    Light light = tests::shaftLight(LightKind::Directional);
    light.shadow.views = tests::shadowViews(light, cascades);
    cases.push_back({std::to_string(cascades) + " cascades", light});
  }
  return cases;
}

// Lamps with the eye, at (0, 2, 0), in each place that matters to a cone, and a lamp that shines all around.
std::vector<Case> lamps() {
  std::vector<Case> cases;
  const auto add = [&](const char* name, LightKind kind, const Vec3& position, const Vec3& direction) {
    Light light = tests::shaftLight(kind);
    light.position = position;
    light.direction = direction;
    cases.push_back({name, light});
  };
  add("spot, eye inside the cone", LightKind::Spot, {0.3, 9.5, -1.5}, {0, -1, 0.1});
  add("spot, eye beside the cone", LightKind::Spot, {-0.6, 9.4, -7}, {0.1, -1, -0.3});
  add("spot, eye behind the cone", LightKind::Spot, {0.4, 2.5, -1.5}, {0.1, -0.1, -1});
  add("spot, shining at the eye", LightKind::Spot, {1.9, 3, -9.5}, {-0.2, -0.1, 1});
  add("point", LightKind::Point, {-0.6, 8.5, -3.5}, {0, -1, 0});
  return cases;
}

// A row's texels are those that its slice meets: it is within half a pixel of the pixels it serves, and what is nearest
// to it in the map is within half a texel of what is nearest to the pixel's ray.
void checkTree(const Case& item, ShadowFilter filter, bool glass) {
  CAPTURE(item.name, static_cast<int>(filter), glass);
  tests::ShaftRig rig(72, 48);
  rig.addLight(item.light, 128, glass);
  rig.scene.frame.settings.shadowFilter = filter;
  const tests::ShaftError error = rig.error(rig.picture(Technique::Tree));
  CHECK(error.displaced > 1e-3);
  CHECK(error.rRmse <= 0.75 * error.displaced); // most pixels are nearer to their slice than half a pixel
}

// Either filter, glass, and glass under the 2x2 filter if `both`.
void checkTree(const Case& item, bool both) {
  checkTree(item, ShadowFilter::Nearest, false);
  checkTree(item, ShadowFilter::Nearest, true);
  checkTree(item, ShadowFilter::Bilinear, false);
  if (both) checkTree(item, ShadowFilter::Bilinear, true);
}

// Rows walked through their tree and texel by texel.
void checkSwitch(const Case& item, ShadowFilter filter, bool glass) {
  CAPTURE(item.name, static_cast<int>(filter), glass);
  tests::ShaftRig rig(48, 32);
  rig.addLight(item.light, 64, glass);
  Settings& settings = rig.scene.frame.settings;
  settings.shadowFilter = filter;
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    settings.minMaxTree = true;
    const reference::Image with = rig.picture(technique);
    settings.minMaxTree = false;
    const reference::Image without = rig.picture(technique);
    CHECK(tests::difference(with, without) <= 1e-6);
    int skipped = 0;
    for (const PassStatistics& pass : tests::testEffect().statistics().passes)
      if (pass.skipped == "settings.minMaxTree is false") ++skipped;
    CHECK(skipped >= 1);
  }
}

} // namespace

TEST_CASE("the tree of a row only saves time: the picture is the same without it") {
  checkSwitch(suns().front(), ShadowFilter::Nearest, false);
  checkSwitch(suns().back(), ShadowFilter::Bilinear, false);
  checkSwitch(lamps().front(), ShadowFilter::Bilinear, true);
  checkSwitch(lamps().back(), ShadowFilter::Nearest, false);
}

TEST_CASE("tree comes close to exact for a sun with one to four cascades") {
  for (const Case& item : suns())
    checkTree(item, item.light.shadow.views.size() % 4 == 0);
}

TEST_CASE("tree comes close to exact for lamps with the eye inside, beside and behind their light") {
  for (const Case& item : lamps())
    checkTree(item, item.light.kind == LightKind::Spot);
}
