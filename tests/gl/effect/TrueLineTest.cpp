// Pixels that are marched along their own line between two slices (settings.spreadThreshold) against exact.
#include "ShaftRig.h"
#include "support/Catch.h"

#include <cmath>
#include <limits>

using namespace tyndall;

namespace {

// No pixel with a surface is served by samples: all those go to the fix-up.
void marchEveryPixel(Settings& settings) {
  settings.leastWeight = 1;
  settings.breakThreshold = 1e-30F;
  settings.spreadThreshold = 1e-6F;
}

// Without the tree a fixed-up pixel is exact's. With it only what both rows beside a ray pass by may differ, thinner
// than the slices are apart: far less than half a texel's displacement makes. Left out are pixels that a sample serves
// after all, at the very distance of theirs.
void checkTrueLines(LightKind kind, int cascades, ShadowFilter filter, bool glass) {
  CAPTURE(static_cast<int>(kind), cascades, static_cast<int>(filter), glass);
  tests::ShaftRig rig(72, 48);
  Light light = tests::shaftLight(kind);
  if (kind == LightKind::Directional) light.shadow.views = tests::shadowViews(light, cascades);
  rig.addLight(light, 128, glass);
  Settings& settings = rig.scene.frame.settings;
  settings.shadowFilter = filter;
  marchEveryPixel(settings);
  settings.minMaxTree = false;
  const reference::Image byCell = rig.picture(Technique::Epipolar);
  CHECK(tests::testEffect().statistics().fixupPixels > 72 * 48 / 2);
  settings.minMaxTree = true;
  const reference::Image byNode = rig.picture(Technique::Epipolar);
  const auto hasSurface = [&](int x, int y) {
    return std::isfinite(rig.scene.distances[static_cast<std::size_t>(y * 72 + x)]);
  };
  const auto isExact = [&](int x, int y) {
    const std::size_t green = 3 * static_cast<std::size_t>(y * 72 + x) + 1;
    return hasSurface(x, y) && std::abs(byCell.rgb[green] - rig.truth().rgb[green]) <= 1e-5 * rig.truth().rgb[green];
  };
  int surface = 0, exact = 0;
  for (int i = 0; i < 72 * 48; ++i) {
    surface += hasSurface(i % 72, i / 72) ? 1 : 0;
    exact += isExact(i % 72, i / 72) ? 1 : 0;
  }
  CHECK(exact >= surface - 5);
  const tests::ShaftError error = rig.error(byNode, isExact);
  CHECK(error.displaced > 1e-4);
  CHECK(error.rRmse <= 0.06 * error.displaced);
}

} // namespace

TEST_CASE("a pixel that is marched along its own line is as exact as by exact", "[slow]") {
  for (const bool glass : {false, true})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point})
        checkTrueLines(kind, 1, filter, glass);
      checkTrueLines(LightKind::Directional, 3, filter, glass);
    }
}

TEST_CASE("a lower spread threshold marches more pixels and errs less") {
  tests::ShaftRig rig(96, 64);
  rig.addLight(tests::shaftLight(LightKind::Directional), 256);
  Settings& settings = rig.scene.frame.settings;
  settings.slices = 40; // coarse
  double before = std::numeric_limits<double>::infinity();
  std::uint64_t pixelsBefore = 0;
  for (const float threshold : {std::numeric_limits<float>::infinity(), 0.1F, 0.03F, 0.01F, 0.001F}) {
    settings.spreadThreshold = threshold;
    const reference::Image picture = rig.picture(Technique::Epipolar);
    const std::uint64_t pixels = tests::testEffect().statistics().fixupPixels;
    const double error = rig.error(picture).rRmse;
    CAPTURE(threshold, error, before, pixels, pixelsBefore);
    CHECK(pixels >= pixelsBefore);
    CHECK(error < before);
    before = error;
    pixelsBefore = pixels;
  }
  CHECK(pixelsBefore > 96 * 64 / 10);
}

TEST_CASE("the picture's mean is neither measured nor used without a spread threshold") {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  const auto passes = [&] {
    int found = 0;
    for (const PassStatistics& pass : tests::testEffect().statistics().passes)
      if (pass.name == "light 0 mean" || pass.name == "light 0 pair tree") ++found;
    return found;
  };
  rig.picture(Technique::Epipolar);
  CHECK(passes() == 0);
  rig.scene.frame.settings.spreadThreshold = 1e-3F;
  rig.picture(Technique::Epipolar);
  CHECK(passes() == 2);
}
