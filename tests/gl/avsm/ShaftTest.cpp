// Shafts through smoke and hair (Light::curves) against the reference, and by every technique.
#include "../effect/ShaftRig.h"
#include "AvsmRig.h"
#include "support/Catch.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kSize = 64;

// Puffs of smoke in every view, between two depths of its range.
std::vector<tests::Captured> puffs(int views, unsigned seed, float low, float high) {
  const float range = high - low;
  tests::Puffs balls;
  balls.size = kSize;
  balls.views = views;
  balls.depth = {low, range};
  balls.thickness = range * glm::vec2(0.05F, 0.1F);
  balls.density = 12 / range;
  return tests::segmentsOf(balls, seed);
}

double errorOf(const reference::Image& image, const reference::Image& truth) {
  return tests::errorWhere(image, truth, [](int, int) { return true; });
}

struct Scene {
  tests::ShaftRig rig;
  std::unique_ptr<tests::AvsmRig> smoke;
  std::vector<tests::Captured> captured;

  explicit Scene(const Light& light, bool glass = false, bool packed = true) : rig(48, 32) {
    rig.addLight(light, 128, glass);
    AvsmConfig config;
    config.size = kSize;
    config.packed = packed;
    config.layers = static_cast<int>(rig.scene.frame.lights[0].shadow.views.size());
    smoke = std::make_unique<tests::AvsmRig>(config);
    fill(3);
  }

  Light& light() { return rig.scene.frame.lights[0]; }

  void fill(unsigned seed) {
    const bool sun = light().kind == LightKind::Directional;
    captured = puffs(static_cast<int>(light().shadow.views.size()), seed, sun ? 0.1F : 0.01F, sun ? 0.5F : 0.13F);
    for (int i = 0; i < 2; ++i) // the memory grows
      smoke->capture(captured);
    REQUIRE(smoke->avsm().statistics().lost == 0);
    light().curves = smoke->avsm().curves();
    rig.scene.curves = {smoke->map()};
  }

  reference::Image picture(Technique technique) {
    rig.scene.frame.settings.technique = technique;
    return rig.scene.render().inscatter;
  }
  reference::Image clear(Technique technique) {
    const AvsmCurves curves = light().curves;
    light().curves = {};
    reference::Image image = picture(technique);
    light().curves = curves;
    return image;
  }
};

constexpr LightKind kKinds[] = {LightKind::Directional, LightKind::Point, LightKind::Spot};
constexpr Technique kFast[] = {Technique::Tree, Technique::Epipolar, Technique::LowRank};

// The smoke counts, exact is the reference's picture, and the others are as near to exact as they are without smoke.
void checkAll(Scene& scene) {
  const reference::Image exact = scene.picture(Technique::Exact), clear = scene.clear(Technique::Exact);
  CHECK(errorOf(clear, exact) > 0.02);
  // The reference takes the texels across the ray at each of its points, exact at the middle of a cell.
  CHECK(errorOf(exact, scene.rig.scene.reference().inscatter) < 2e-3);
  for (const Technique technique : kFast) {
    const double without = errorOf(scene.clear(technique), clear), with = errorOf(scene.picture(technique), exact);
    CAPTURE(static_cast<int>(technique), without, with);
    CHECK(with < 1.2 * without + 0.005);
  }
}

} // namespace

TEST_CASE("avsm shafts: all lights, packed or not, with glass or without", "[sweep][slow]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : kKinds)
    for (const bool glass : {false, true}) {
      CAPTURE(static_cast<int>(kind), glass);
      Scene scene(tests::shaftLight(kind), glass, !glass);
      checkAll(scene);
    }
}

TEST_CASE("avsm shafts: filtered shadows, cascades, coloured media and every setting of rows", "[sweep][slow]") {
  if (!tests::hasAvsm()) return;
  const std::vector<std::pair<const char*, std::function<void(Frame&)>>> changes = {
      {"bilinear", [](Frame& f) { f.settings.shadowFilter = ShadowFilter::Bilinear; }},
      {"no tree", [](Frame& f) { f.settings.minMaxTree = false; }},
      {"no averages", [](Frame& f) { f.settings.averageThreshold = 0; }},
      {"row step", [](Frame& f) { f.settings.rowStep = 2; }},
      {"coloured", [](Frame& f) { f.medium.constituents = {{{0.02F, 0.05F, 0.09F}, Phase::Rayleigh, 0}}; }},
      {"spread", [](Frame& f) { f.settings.spreadThreshold = 0.01F; }}};
  for (const auto& [name, change] : changes)
    for (const LightKind kind : {LightKind::Directional, LightKind::Spot}) {
      CAPTURE(name, static_cast<int>(kind));
      Scene scene(tests::shaftLight(kind));
      change(scene.rig.scene.frame);
      checkAll(scene);
    }
  Light cascades = tests::shaftLight(LightKind::Directional);
  cascades.shadow.views = tests::shadowViews(cascades, 3);
  Scene scene(cascades);
  checkAll(scene);
  scene.light().cascadeFade = 0.2; // the reference for curves knows no fades
  const reference::Image exact = scene.picture(Technique::Exact);
  for (const Technique technique : kFast)
    CHECK(errorOf(scene.picture(technique), exact) < 0.04);
}

TEST_CASE("avsm shafts: curves of eight nodes are near to all that was captured", "[slow]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : kKinds) {
    Scene scene(tests::shaftLight(kind));
    const auto texels = static_cast<std::size_t>(kSize * kSize);
    std::vector<std::vector<reference::Segment>> segments(texels * scene.light().shadow.views.size());
    for (const tests::Captured& s : scene.captured)
      segments[static_cast<std::size_t>((s.texel.z * kSize + s.texel.y) * kSize + s.texel.x)].push_back(
          {s.entry, s.exit, s.transmittance});
    reference::CurveMap all{kSize, {}};
    constexpr int kDepths = 1000;
    for (const auto& list : segments) {
      all.curves.emplace_back();
      for (int i = 0; i <= kDepths; ++i)
        all.curves.back().emplace_back(i / double(kDepths), reference::transmittanceAt(list, i / double(kDepths)));
    }
    scene.rig.scene.curves = {all};
    const reference::Image uncompressed = scene.rig.scene.reference().inscatter;
    for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
      const double error = errorOf(scene.picture(technique), uncompressed);
      CAPTURE(static_cast<int>(kind), static_cast<int>(technique), error);
      CHECK(error <
            0.03 +
                (technique == Technique::Exact ? 0 : errorOf(scene.clear(technique), scene.clear(Technique::Exact))));
    }
  }
}

TEST_CASE("avsm shafts: an opaque sheet before the light leaves no light, one that lets half through leaves half") {
  if (!tests::hasAvsm()) return;
  for (const float passed : {0.0F, 0.5F}) {
    Light light = tests::shaftLight(LightKind::Spot);
    light.litOutsideViews = false;
    Scene scene(light);
    std::vector<tests::Captured> sheet;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        sheet.push_back({{x, y, 0}, 0, 0, passed});
    scene.smoke->capture(sheet);
    scene.light().curves = scene.smoke->avsm().curves();
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
      reference::Image clear = scene.clear(technique);
      for (double& value : clear.rgb)
        value *= passed;
      CHECK(errorOf(scene.picture(technique), clear) <= 1e-4);
    }
  }
}

TEST_CASE("avsm shafts: temporal reuse draws anew when the curves change, and only then") {
  if (!tests::hasAvsm()) return;
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    Scene scene(tests::shaftLight(LightKind::Directional));
    Frame& frame = scene.rig.scene.frame;
    frame.settings.technique = Technique::Epipolar;
    frame.reuse = {changes, 9000 + static_cast<std::uint64_t>(changes), 0, 1.0F, 0};
    frame.depth.version = scene.light().shadow.version = 1;
    const auto shareOf = [&] {
      const reference::Image reused = scene.rig.scene.render().inscatter;
      const double share = tests::testEffect().statistics().redrawnShare;
      const Reuse reuse = frame.reuse;
      frame.reuse = {};
      CHECK(tests::difference(reused, scene.rig.scene.render().inscatter) <= 1e-5);
      frame.reuse = reuse;
      ++frame.reuse.frame;
      return share;
    };
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
    scene.fill(4);
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
    scene.light().curves.version = 0; // not known
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 1);
    scene.light().curves = {};
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
  }
}

TEST_CASE("avsm shafts: curves that break their rules are refused, field and rule named") {
  if (!tests::hasAvsm()) return;
  Scene scene(tests::shaftLight(LightKind::Spot));
  const auto checkRefused = [&](const std::string& part, const std::function<void(Light&)>& spoil) {
    Frame frame = scene.rig.scene.frame;
    spoil(frame.lights[0]);
    const Status status = tests::testEffect().render(frame);
    CAPTURE(status.message, part);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find("lights[0]." + part) != std::string::npos);
  };
  checkRefused("curves.nodes is 5", [](Light& l) { l.curves.nodes = 5; });
  checkRefused("curves.texture is texture 987654", [](Light& l) { l.curves.texture = 987654; });
  checkRefused("curves.texture", [](Light& l) { l.curves.texture = l.shadow.texture; });
  checkRefused("shadow.texture is 0", [](Light& l) { l.shadow = {}; });
  checkRefused("curves.texture", [](Light& l) { l.curves.nodes = 16; }); // more layers than there are
  checkRefused("shadow.views[0].clipFromWorld is without a far plane", [](Light& l) {
    const glm::dvec3 eye = reference::toVec3(l.position), ahead = reference::toVec3(l.direction);
    const glm::dmat4 view = glm::lookAt(eye, eye + ahead, glm::dvec3(0, 0, 1));
    l.shadow.views[0].clipFromWorld = tests::toMat4(glm::infinitePerspective(1.8, 1.0, 0.1) * view);
  });
}
