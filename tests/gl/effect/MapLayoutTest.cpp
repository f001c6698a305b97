// The same texels wherever an engine keeps them: an atlas, rectangles of layers, cube maps, views of several sizes. The
// picture is that of an array with a layer for each view.
#include "MapLayoutRig.h"
#include "gl/avsm/AvsmRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <limits>

using namespace tyndall;
using tests::identical;
using tests::LaidMaps;
using tests::Layout;
using tests::ShaftRig;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

constexpr Technique kTechniques[] = {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank};

// Draws with the maps in another layout; the rig's light is as it was.
reference::Image pictureIn(ShaftRig& rig, const LaidMaps& maps, Technique technique) {
  const Frame frame = rig.scene.frame;
  maps.enter(rig.scene.frame.lights[0]);
  reference::Image picture = rig.picture(technique);
  rig.scene.frame = frame;
  return picture;
}

template <typename Function>
void forEachFrame(LightKind kind, Function&& function) {
  for (const bool glass : {false, true}) {
    const std::unique_ptr<ShaftRig> rig = tests::layoutRig(kind, glass);
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const Technique technique : kTechniques) {
        CAPTURE(static_cast<int>(kind), glass, static_cast<int>(filter), static_cast<int>(technique));
        rig->scene.frame.settings.shadowFilter = filter;
        function(*rig, technique);
      }
  }
}

void checkTiles(LightKind kind) {
  forEachFrame(kind, [&](ShaftRig& rig, Technique technique) {
    const reference::ShadowImage& image = rig.scene.shadow(0);
    const reference::Image array = rig.picture(technique);
    for (const Layout layout : {Layout::Atlas, Layout::Sheets})
      for (const float poison : {0.0F, kNan}) {
        CAPTURE(static_cast<int>(layout), poison);
        CHECK(identical(pictureIn(rig, LaidMaps(image, layout, poison), technique), array));
      }
  });
}

} // namespace

TEST_CASE("tiles of an atlas give a sun the picture of an array, and nothing beside them is read", "[sweep]") {
  checkTiles(LightKind::Directional);
}

TEST_CASE("tiles of an atlas give a lamp the picture of an array, and nothing beside them is read", "[sweep]") {
  checkTiles(LightKind::Point);
}

TEST_CASE("a tile of an atlas gives a spot the picture of an array, and nothing beside it is read") {
  checkTiles(LightKind::Spot);
}

TEST_CASE("a cube map gives the picture of an array of its faces") {
  forEachFrame(LightKind::Point, [](ShaftRig& rig, Technique technique) {
    const reference::ShadowImage& image = rig.scene.shadow(0);
    const reference::Image array = rig.picture(technique);
    CHECK(identical(pictureIn(rig, LaidMaps(image, Layout::Cube, 0), technique), array));
    CHECK(identical(pictureIn(rig, LaidMaps(image, Layout::CubeArray, 0), technique), array));
  });
}

TEST_CASE("atlases and cubes that change the picture are told apart") { // that the tests above can fail
  const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, false);
  const reference::Image array = rig->picture(Technique::Exact);
  for (const Layout layout : {Layout::Atlas, Layout::Cube, Layout::CubeArray}) {
    reference::ShadowImage image = rig->scene.shadow(0);
    const auto face = static_cast<std::ptrdiff_t>(image.depth.size() / 6);
    std::rotate(image.depth.begin(), image.depth.begin() + face, image.depth.end());
    CHECK(tests::relativeError(pictureIn(*rig, LaidMaps(image, layout, 0), Technique::Exact), array) > 0.1);
  }
}

namespace {

// The rig's maps with every second view at twice the size: each texel four times. Nothing is lost of them.
struct MixedMaps {
  host::GlTexture atlas, sheets;
  std::vector<ShadowView> inAtlas, inSheets;

  explicit MixedMaps(const ShaftRig& rig) {
    const reference::ShadowImage& image = rig.scene.shadow(0);
    const int n = image.width, layers = image.layers;
    const auto count = static_cast<std::size_t>(layers);
    std::vector<float> a(count * static_cast<std::size_t>(4 * n * n), 0), s(a);
    const std::vector<ShadowView>& views = rig.scene.frame.lights[0].shadow.views;
    for (int v = 0; v < layers; ++v) {
      const int scale = 1 + v % 2, size = scale * n;
      inAtlas.push_back({views[static_cast<std::size_t>(v)].clipFromWorld, 0, {0, 2 * n * v, size, size}});
      inSheets.push_back({views[static_cast<std::size_t>(v)].clipFromWorld, v, {2 * n - size, 0, size, size}});
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          const float depth = image.depth[static_cast<std::size_t>((v * n + y / scale) * n + x / scale)];
          a[static_cast<std::size_t>((2 * n * v + y) * 2 * n + x)] = depth;
          s[static_cast<std::size_t>((2 * n * v + y) * 2 * n + x + 2 * n - size)] = depth;
        }
    }
    atlas = tests::floatTexture(GL_R32F, 2 * n, 2 * n * layers, a);
    sheets = tests::floatTextureArray(GL_R32F, 2 * n, 2 * n, layers, s);
  }
};

} // namespace

TEST_CASE("views of several sizes: in an atlas as in an array, and as many texels for one change nothing", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point}) {
    const std::unique_ptr<ShaftRig> rig = tests::layoutRig(kind, false);
    const MixedMaps maps(*rig);
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const Technique technique : kTechniques) {
        CAPTURE(static_cast<int>(kind), static_cast<int>(filter), static_cast<int>(technique));
        Light& light = rig->scene.frame.lights[0];
        rig->scene.frame.settings.shadowFilter = filter;
        const Light before = light;
        const reference::Image whole = rig->picture(technique);
        light.shadow.views = maps.inSheets;
        light.shadow.texture = maps.sheets.name();
        const reference::Image sheets = rig->picture(technique);
        light.shadow.array = false;
        light.shadow.views = maps.inAtlas;
        light.shadow.texture = maps.atlas.name();
        CHECK(identical(rig->picture(technique), sheets));
        light = before;
        if (filter == ShadowFilter::Nearest && technique == Technique::Exact)
          CHECK(tests::relativeError(sheets, whole) <= 1e-5);
        if (filter == ShadowFilter::Nearest && technique == Technique::Tree) // whose steps are shorter then
          CHECK(tests::relativeError(sheets, whole) <= 0.05);
      }
  }
}

TEST_CASE("a cube map's reversed depth, endless or not, is read as its matrices have it") {
  for (const bool endless : {false, true})
    for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
      CAPTURE(endless, static_cast<int>(clipDepth));
      const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, false);
      const reference::Image array = rig->picture(Technique::Exact);
      Light& light = rig->scene.frame.lights[0];
      reference::ShadowImage image = rig->scene.shadow(0);
      for (float& depth : image.depth) { // a distance, and what reversed depth makes of it
        const double near = tests::kFaceNear, far = tests::kFaceFar;
        const double d = near * far / (far - static_cast<double>(depth) * (far - near));
        depth = static_cast<float>(depth >= 1 ? 0 : endless ? near / d : near * (far - d) / (d * (far - near)));
      }
      const LaidMaps maps(image, Layout::Cube, 0);
      maps.enter(light);
      light.shadow.clipDepth = clipDepth;
      light.shadow.cube.reversedDepth = true;
      if (endless) light.shadow.cube.farDistance = kInfinity;
      CHECK(tests::relativeError(rig->picture(Technique::Exact), array) <= 1e-4);
    }
}

TEST_CASE("smoke dims a lamp alike wherever its maps lie", "[sweep]") {
  if (tests::testContext().glVersion() < 43) return; // adaptive volumetric shadow maps need it
  AvsmConfig config = tests::configOf(CurveReduction::Sorted, 16, 4, true);
  config.layers = 6;
  tests::AvsmRig smoke(config);
  std::vector<tests::Captured> segments;
  for (int face = 0; face < 6; ++face)
    for (int y = 2; y < 14; ++y)
      for (int x = 3 + face; x < 12; ++x)
        segments.push_back({{x, y, face}, 0.01F, 0.08F, 0.3F});
  smoke.capture(segments);
  for (const bool glass : {false, true}) {
    const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, glass);
    const reference::Image clear = rig->picture(Technique::Exact);
    Light& light = rig->scene.frame.lights[0];
    light.curves = smoke.avsm().curves();
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const Technique technique : kTechniques) {
        CAPTURE(glass, static_cast<int>(filter), static_cast<int>(technique));
        rig->scene.frame.settings.shadowFilter = filter;
        const reference::Image array = rig->picture(technique);
        CHECK(tests::relativeError(array, clear) > 0.05);
        for (const Layout layout : {Layout::Atlas, Layout::Cube})
          CHECK(identical(pictureIn(*rig, LaidMaps(rig->scene.shadow(0), layout, 0), technique), array));
      }
  }
}
