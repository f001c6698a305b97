// Technique tree on every kind of shadow map against exact.
#include "ShaftRig.h"
#include "support/Catch.h"

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
  cases.push_back(cases.back());
  cases.back().name += " that fade";
  cases.back().light.cascadeFade = 0.2;
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
  settings.averageThreshold = 0;
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

// Nodes taken by their average, and all of them opened.
bool checkAverages(const Case& item, ShadowFilter filter, bool glass) {
  CAPTURE(item.name, static_cast<int>(filter), glass);
  tests::ShaftRig rig(72, 48);
  rig.addLight(item.light, 512, glass);
  Settings& settings = rig.scene.frame.settings;
  settings.technique = Technique::Tree;
  settings.shadowFilter = filter;
  settings.averageThreshold = 0;
  const reference::Image opened = rig.picture(Technique::Tree);
  const tests::ShaftError floor = rig.error(opened);
  settings.averageThreshold = 0.1F;
  const reference::Image averaged = rig.picture(Technique::Tree);
  CHECK(tests::errorWhere(averaged, opened, [](int, int) { return true; }) <= 5e-4);
  CHECK(rig.error(averaged).rRmse <= 1.01 * floor.rRmse + 1e-5);
  return tests::difference(opened, averaged) > 0; // or no node was averaged
}

// Visits of a ray through slats near the light.
double visitsThroughSlats(float averageThreshold) {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 512);
  reference::ShadowImage slats = rig.scene.shadow(0);
  for (std::size_t i = 0; i < slats.depth.size(); ++i)
    slats.depth[i] = i / 512 / 3 % 2 == i % 512 / 5 % 2 ? 0.05F : 0.999F;
  rig.scene.setShadow(0, slats);
  rig.scene.frame.settings.averageThreshold = averageThreshold;
  rig.scene.frame.settings.debugView = DebugView::NodeVisits;
  const host::GlTexture colour = host::makeTexture2D(GL_RGBA16F, 48, 32);
  rig.scene.frame.colour = colour.name();
  rig.picture(Technique::Tree);
  return tests::testEffect().statistics().visitsPerRay;
}

} // namespace

TEST_CASE("nodes between two layers of casters are taken by their average", "[sweep]") {
  bool averagedLamp = false;
  for (const bool glass : {false, true})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CHECK(checkAverages(suns().front(), filter, glass));
      checkAverages(suns().back(), filter, glass); // at the seams of coarse cascades
      averagedLamp = checkAverages(lamps().front(), filter, glass) || averagedLamp;
      averagedLamp = checkAverages(lamps().back(), filter, glass) || averagedLamp;
    }
  CHECK(averagedLamp);
}

TEST_CASE("averages spare most visits behind slats") {
  const double opened = visitsThroughSlats(0), averaged = visitsThroughSlats(1);
  CAPTURE(opened, averaged);
  CHECK(opened > 20);
  CHECK(averaged <= 0.4 * opened);
}

TEST_CASE("the tree of a row only saves time: the picture is the same without it", "[sweep]") {
  checkSwitch(suns().front(), ShadowFilter::Nearest, false);
  checkSwitch(suns().back(), ShadowFilter::Bilinear, false);
  checkSwitch(lamps().front(), ShadowFilter::Bilinear, true);
  checkSwitch(lamps().back(), ShadowFilter::Nearest, false);
}

TEST_CASE("tree comes close to exact for a sun with one to four cascades", "[sweep]") {
  for (const Case& item : suns())
    checkTree(item, item.light.shadow.views.size() % 4 == 0);
}

TEST_CASE("tree comes close to exact for lamps with the eye inside, beside and behind their light", "[sweep]") {
  for (const Case& item : lamps())
    checkTree(item, item.light.kind == LightKind::Spot);
}
