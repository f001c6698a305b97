// Techniques tree and epipolar on inputs that leave them little or nothing to work with: a clear status, or a finite
// picture that is close to that of exact.
#include "RefusalRig.h"
#include "ShaftRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

using namespace tyndall;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
const std::vector<LightKind> kKinds = {LightKind::Directional, LightKind::Point, LightKind::Spot};

void checkFinite(tests::ShaftRig& rig, Technique technique) {
  CAPTURE(static_cast<int>(technique));
  rig.scene.frame.settings.technique = technique;
  tests::checkFinite(rig.scene);
}

// Finite, and off exact by no more than half a pixel and the bend that epipolar leaves between two samples.
void checkAgainstExact(tests::ShaftRig& rig) {
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    checkFinite(rig, technique);
    const tests::ShaftError error = rig.error(rig.scene.outputs().inscatter);
    CAPTURE(static_cast<int>(technique), error.rRmse, error.displaced);
    CHECK(error.rRmse <= error.displaced + (technique == Technique::Tree ? 1e-3 : 0.02));
  }
}

struct Knob {
  std::string field;
  void (*set)(Settings&, double value);
  std::vector<double> refused;
  std::vector<double> accepted;
  std::string rule;
};

const std::vector<Knob> kKnobs = {
    {"slices",
     [](Settings& s, double v) { s.slices = static_cast<int>(v); },
     {0, -1, -2147483648.0, 8193, 2147483647.0},
     {1, 2, 3, 7, 333, 8192},
     "must be 1 to 8192"},
    {"samples",
     [](Settings& s, double v) { s.samples = static_cast<int>(v); },
     {0, -64, -2147483648.0, 1, 63, 65, 127, 1000, 8193, 8256, 2147483584.0},
     {64, 128, 192, 8192},
     "must be a multiple of 64 from 64 to 8192"},
    {"rowStep",
     [](Settings& s, double v) { s.rowStep = static_cast<int>(v); },
     {0, -1, -2147483648.0, 9, 2147483647.0},
     {1, 2, 3, 8},
     "must be 1 to 8"},
    {"breakThreshold",
     [](Settings& s, double v) { s.breakThreshold = static_cast<float>(v); },
     {kNan, 0, -0.1, kInf, -kInf},
     {1e-38, 1, 1e38},
     "must be finite and > 0"},
    {"bendThreshold",
     [](Settings& s, double v) { s.bendThreshold = static_cast<float>(v); },
     {kNan, 0, -0.1, -kInf},
     {1e-38, 1, kInf},
     "must be > 0"},
    {"leastWeight",
     [](Settings& s, double v) { s.leastWeight = static_cast<float>(v); },
     {kNan, -1e-6, 1.000001, kInf, -kInf},
     {0, 1e-38, 1},
     "must be 0 to 1"},
    {"averageThreshold",
     [](Settings& s, double v) { s.averageThreshold = static_cast<float>(v); },
     {kNan, -1e-6, 1.000001, kInf, -kInf},
     {0, 1e-38, 1},
     "must be 0 to 1"},
    {"spreadThreshold",
     [](Settings& s, double v) { s.spreadThreshold = static_cast<float>(v); },
     {kNan, 0, -0.1, -kInf},
     {1e-38, 0.05, kInf},
     "must be > 0"},
    {"errorTarget",
     [](Settings& s, double v) { s.errorTarget = static_cast<float>(v); },
     {kNan, -1e-6, 1.000001, kInf, -kInf},
     {0, 1e-38, 1},
     "must be 0 to 1"},
    {"sampleBudget",
     [](Settings& s, double v) { s.sampleBudget = static_cast<int>(v); },
     {-1, 1, 4095},
     {0, 4096, 1e9},
     "must be 0 or at least 4096"},
    {"lowRankTerms",
     [](Settings& s, double v) { s.lowRankTerms = static_cast<int>(v); },
     {0, 9, -1},
     {1, 8},
     "must be 1 to 8"},
};

// A map of stripes that are wide against a texel, in front of and behind what the eye sees.
reference::ShadowImage stripes(int width, int height, int layers) {
  const int length = std::max(width, height), stripe = std::max(length / 8, 1);
  reference::ShadowImage image{width, height, layers, {}, {}, {}};
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < width * height; ++i)
      image.depth.push_back((i / stripe + layer) % 2 == 0 ? 0.4F : 1.0F);
  return image;
}

} // namespace

TEST_CASE("a knob of the epipolar technique that breaks its rule is refused, field and rule named") {
  tests::RefusalRig rig;
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
    for (const Knob& knob : kKnobs)
      for (const double value : knob.refused) {
        CAPTURE(knob.field, value);
        Frame broken = rig.frame;
        broken.settings.technique = technique;
        knob.set(broken.settings, value);
        rig.checkRefused(broken, {"Frame::settings." + knob.field + " is ", knob.rule});
      }
  rig.checkAccepted(rig.frame);
}

TEST_CASE("a knob of the epipolar technique at the ends of its range gives a finite picture", "[sweep]") {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 32);
  for (const Knob& knob : kKnobs)
    for (const double value : knob.accepted) {
      CAPTURE(knob.field, value);
      rig.scene.frame.settings = {};
      knob.set(rig.scene.frame.settings, value);
      for (const Technique technique : {Technique::Tree, Technique::Epipolar, Technique::LowRank})
        checkFinite(rig, technique);
    }
}

TEST_CASE("a pixel is marched by itself where a knob lets no sample serve it") {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  const tests::ShaftError tree = rig.error(rig.picture(Technique::Tree));
  rig.scene.frame.settings.breakThreshold = 1e-30F; // no two distances agree: no sample has any weight
  for (const float leastWeight : {1.0F, 0.0F}) {
    rig.scene.frame.settings.leastWeight = leastWeight;
    const tests::ShaftError epipolar = rig.error(rig.picture(Technique::Epipolar));
    CAPTURE(leastWeight, tree.rRmse, epipolar.rRmse);
    CHECK(tests::testEffect().statistics().fixupPixels > 48 * 32 / 2);
    CHECK(epipolar.rRmse <= 1.5 * tree.rRmse);
  }
}

TEST_CASE("shadow maps of one texel and of one row or column", "[sweep]") {
  tests::testContext();
  GLint largest = 0;
  host::gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  largest = std::min(largest, 16384);
  for (const LightKind kind : kKinds)
    for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(largest, 1), glm::ivec2(1, largest), glm::ivec2(3, 2)})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
        // The driver compiles every shader anew for a shape of map: a point light, slow to compile, has 1x1 and the
        // row.
        if (kind == LightKind::Point && size.y > 1) continue;
        if (kind != LightKind::Directional && filter == ShadowFilter::Bilinear) continue;
        CAPTURE(static_cast<int>(kind), size.x, size.y, static_cast<int>(filter));
        tests::ShaftRig rig(18, 12);
        rig.addLight(tests::shaftLight(kind), 1);
        rig.scene.setShadow(0, stripes(size.x, size.y, rig.scene.shadow(0).layers));
        rig.scene.frame.settings.shadowFilter = filter;
        rig.changed();
        checkAgainstExact(rig);
      }
}

TEST_CASE("pictures of one pixel, one column and one row", "[sweep]") {
  for (const LightKind kind : kKinds)
    for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(1, 2000), glm::ivec2(8192, 1)}) {
      CAPTURE(static_cast<int>(kind), size.x, size.y);
      tests::ShaftRig rig(size.x, size.y);
      rig.addLight(tests::shaftLight(kind), 64);
      if (kind == LightKind::Point && size != glm::ivec2(1, 1)) continue; // six faces at such sizes take long
      checkAgainstExact(rig);
    }
}

TEST_CASE("a light on the one row of an image is left in both directions") {
  for (const double side : {-0.15, 0.0, 0.2}) {
    CAPTURE(side);
    tests::ShaftRig rig(400, 1);
    Light light = tests::shaftLight(LightKind::Directional);
    light.direction = {side, 0, 1};
    light.shadow.views = tests::shadowViews(light, 1);
    rig.addLight(light, 256);
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) { // slices run through all pixels
      checkFinite(rig, technique);
      CHECK(rig.error(rig.scene.outputs().inscatter).rRmse < 2e-3);
    }
  }
}

TEST_CASE("shadow views whose rows do not fit into one texture take several draws") {
  for (const float spreadThreshold : {kInf, 1e-3F})
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      CAPTURE(spreadThreshold, static_cast<int>(technique));
      tests::ShaftRig rig(8192, 1); // a slice for each pixel of the border
      Light light = tests::shaftLight(LightKind::Directional);
      light.shadow.views = tests::shadowViews(light, 4);
      light.cascadeFade = 0.1;
      rig.addLight(light, 64);
      rig.scene.frame.settings.spreadThreshold = spreadThreshold;
      const auto picture = [&](int slices, int& draws) {
        rig.scene.frame.settings.slices = slices;
        reference::Image image = rig.picture(technique);
        draws = 0;
        for (const PassStatistics& pass : tests::testEffect().statistics().passes)
          draws += pass.name == "light 0 rows" ? 1 : 0;
        return image;
      };
      int together = 0, apart = 0;
      const reference::Image one = picture(2048, together), several = picture(8192, apart);
      CHECK(together == 1);
      CHECK(apart >= 2);
      CHECK(tests::errorWhere(several, one, [](int, int) { return true; }) <= 2.5e-3);
    }
}

TEST_CASE("a depth buffer that is all sky, all NaN, all at the eye or without meaning") {
  for (const LightKind kind : kKinds)
    for (const float depth : {0.0F, kNan, 1.0F, kInf, -kInf, -1.0F, 2.0F}) { // 0 is the far value
      CAPTURE(static_cast<int>(kind), depth);
      tests::ShaftRig rig;
      rig.addLight(tests::shaftLight(kind), 64);
      rig.scene.setDepth(std::vector<float>(96 * 64, depth));
      rig.changed();
      checkAgainstExact(rig);
      if (depth == depth) continue;
      for (const Technique technique : {Technique::Tree, Technique::Epipolar})
        CHECK(rig.picture(technique).rgb == std::vector<double>(3 * 96 * 64, 0.0));
    }
}

TEST_CASE("a lamp at the eye and next to it") {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot})
    for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(0, 0, 1e-7), glm::dvec3(0, 0, -1e-7),
                                     glm::dvec3(1e-7, 0, 0), glm::dvec3(0.2, 0.3, 0), glm::dvec3(-0.2, 0.1, 0.3)})
      for (const Vec3& direction : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{0.3, -1, 0}}) {
        if (kind == LightKind::Point && direction[2] >= 0) continue;
        CAPTURE(static_cast<int>(kind), offset.x, offset.y, offset.z, direction[2]);
        tests::ShaftRig rig;
        Light light = tests::shaftLight(kind);
        light.position = {offset.x, 2 + offset.y, offset.z};
        light.direction = direction;
        rig.addLight(light, 64);
        for (const Technique technique : {Technique::Tree, Technique::Epipolar})
          checkFinite(rig, technique);
        if (glm::length(offset) > 0.1) checkAgainstExact(rig); // nearer it outshines everything: no scale is left
      }
}

TEST_CASE("a sun or spot that shines along or against the view axis") {
  for (const double sign : {1.0, -1.0})
    for (const double along : {-3.0, 3.0}) {
      CAPTURE(sign, along);
      tests::ShaftRig spot(95, 63), sun(95, 63); // the middle pixel's ray is the axis
      Light light = tests::shaftLight(LightKind::Spot);
      light.position = {0, 2, -along};
      light.direction = {0, 0, -sign};
      spot.addLight(light, 64);
      checkAgainstExact(spot);
      light.kind = LightKind::Directional;
      sun.addLight(light, 64);
      checkAgainstExact(sun);
    }
}

TEST_CASE("shadow views that are thin, narrow, elsewhere or edge-on") {
  Light sun = tests::shaftLight(LightKind::Directional), lamp = tests::shaftLight(LightKind::Spot);
  const auto along = glm::dvec3(0, 2, 0) - 22.0 * reference::toVec3(sun.direction);
  const glm::dmat4 sunView = glm::lookAt(along, glm::dvec3(0, 2, 0), glm::dvec3(0, 1, 0));
  const auto lampAt = [&](const Vec3& position, const Vec3& direction, double angle) {
    lamp.position = position;
    lamp.direction = direction;
    const glm::dvec3 p = reference::toVec3(position);
    lamp.shadow.views = {{tests::toMat4(glm::perspective(angle, 1.0, 0.1, 60.0) *
                                        glm::lookAt(p, p + reference::toVec3(direction), glm::dvec3(0, 0.6, 0.8))),
                          0}};
    return lamp;
  };
  const auto sunThrough = [&](const glm::dmat4& clipFromView) {
    sun.shadow.views = {{tests::toMat4(clipFromView * sunView), 0}};
    return sun;
  };
  const std::vector<std::pair<const char*, Light>> lights = {
      {"thin sheet", sunThrough(glm::ortho(-16.0, 16.0, -1e-6, 1e-6, 1.0, 60.0))},
      {"thin rod", sunThrough(glm::ortho(-1e-6, 1e-6, -1e-6, 1e-6, 1.0, 60.0))},
      {"no depth", sunThrough(glm::ortho(-16.0, 16.0, -16.0, 16.0, 20.0, 20.0 + 1e-6))},
      {"elsewhere", sunThrough(glm::ortho(-1016.0, -1000.0, -16.0, 16.0, 1.0, 60.0))},
      {"huge", sunThrough(glm::ortho(-1e9, 1e9, -1e9, 1e9, 1.0, 1e9))},
      {"narrow", lampAt({0.5, 6, -5}, {0, -1, 0}, 1e-5)},
      {"wide", lampAt({0.5, 6, -5}, {0, -1, 0}, 3.0)},
      {"eye in the plane of the lamp", lampAt({1, 2, 0}, {0, 0, -1}, 1.5)}, // where its view's w is 0
      {"eye before the lamp", lampAt({1, 2, 5}, {0, 0, -1}, 1.5)},
  };
  for (const auto& [name, light] : lights)
    for (const bool lit : {false, true}) {
      CAPTURE(name, lit);
      tests::ShaftRig rig;
      rig.addLight(light, 64).litOutsideViews = lit;
      rig.scene.setShadow(0, stripes(64, 64, 1));
      rig.changed();
      checkAgainstExact(rig);
    }
}

TEST_CASE("a sample budget marches fewer rays, and two lights under it come near those without") {
  tests::ShaftRig rig(96, 64);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  rig.addLight(tests::shaftLight(LightKind::Point), 64);
  const reference::Image full = rig.picture(Technique::Epipolar);
  const std::uint64_t marched = tests::testEffect().statistics().marchedSamples;
  rig.scene.frame.settings.sampleBudget = 2 * 128 * 64;
  const reference::Image dealt = rig.picture(Technique::Epipolar);
  CHECK(2 * tests::testEffect().statistics().marchedSamples < marched + 96 * 64);
  const double error = tests::errorWhere(dealt, full, [](int, int) { return true; });
  CHECK(error > 0);
  CHECK(error < 0.025);
}
