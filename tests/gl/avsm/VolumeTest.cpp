// Avsm::drawVolumes(): boxes and spheres of fog, even or on a grid, against closed forms and quadrature in double
// precision.
#include "VolumeRig.h"
#include "gl/effect/GlState.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

using namespace tyndall;
using host::gl;
using tests::AvsmRig;
using tests::Curve;
using tests::DensityTexture;
using tests::Fog;
using tests::parallelLight;
using tests::spotLight;
using Shape = AvsmVolume::Shape;

namespace {

AvsmConfig configOf(int size, int nodes = 16) { return tests::configOf(CurveReduction::WholeCurve, size, nodes); }

std::vector<AvsmVolume> volumesOf(const std::vector<Fog>& all) {
  std::vector<AvsmVolume> volumes;
  for (const Fog& fog : all)
    volumes.push_back(fog.volume);
  return volumes;
}

// frames: of capturing two, where lists grow, which they do once a frame has told how much they need.
void draw(AvsmRig& rig, const Light& light, const std::vector<AvsmVolume>& volumes, bool streamed = false,
          int frames = 1) {
  if (frames > 1) draw(rig, light, volumes, streamed, frames - 1);
  REQUIRE((streamed ? rig.avsm().beginStreaming() : rig.avsm().begin(2)));
  const Status drawn = rig.avsm().drawVolumes(light, volumes);
  INFO(drawn.message);
  REQUIRE(drawn);
  const Status resolved = rig.avsm().resolve();
  INFO(resolved.message);
  REQUIRE(resolved);
  gl().Finish();
}

Mat4 placed(const glm::dvec3& centre, const glm::dvec3& halfSize, double turn = 0) {
  glm::dmat4 m = glm::translate(glm::dmat4(1), centre);
  m = glm::rotate(m, turn, glm::normalize(glm::dvec3(1, 2, -0.5)));
  return tests::toMat4(glm::scale(m, halfSize));
}

AvsmVolume volumeOf(Shape shape, const Mat4& place, double extinction, double fade = 0, std::uint32_t density = 0) {
  AvsmVolume volume;
  volume.shape = shape;
  volume.worldFromVolume = place;
  volume.extinction = extinction;
  volume.fade = fade;
  volume.density = density;
  return volume;
}

// What comes through each texel at the end, and the largest mean difference of a curve.
struct Errors {
  double whole = 0, curve = 0;
};

Errors errorsOf(const AvsmRig& rig, int size, const Light& light, const std::vector<Fog>& all, double lightDepth = -1e9,
                int view = 0) {
  Errors errors;
  const reference::CurveMap map = rig.map();
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto ray = tests::texelRay(light, view, size, x, y);
      const Curve& curve = map.curves[static_cast<std::size_t>((view * size + y) * size + x)];
      const double whole = tests::passedBy(all, ray, 1, lightDepth);
      errors.whole = std::max(errors.whole, std::abs(curve.back().y - whole));
      constexpr int kDepths = 24;
      double sum = 0;
      for (int i = 0; i < kDepths; ++i) {
        const double depth = (i + 0.5) / kDepths;
        sum += std::abs(tests::curveAt(curve, depth) - tests::passedBy(all, ray, depth, lightDepth)) / kDepths;
      }
      errors.curve = std::max(errors.curve, sum);
    }
  return errors;
}

} // namespace

TEST_CASE("avsm volumes: what is even is one segment a texel, of the chord") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 12;
  for (const Shape shape : {Shape::Box, Shape::Sphere})
    for (const bool turned : {false, true}) {
      const std::vector<Fog> fog = {
          {volumeOf(shape, placed({0.1, -0.05, 0.2}, {0.5, 0.6, 0.3}, turned ? 0.7 : 0), 2.5), {}}};
      AvsmRig rig(configOf(kSize));
      draw(rig, parallelLight(), volumesOf(fog));
      CAPTURE(turned, static_cast<int>(shape));
      const Errors errors = errorsOf(rig, kSize, parallelLight(), fog);
      CHECK(errors.whole < 1e-5);
      CHECK(errors.curve < 3e-3); // lines between the ends of an exponential
      std::uint64_t seen = 0;
      for (const Curve& curve : rig.map().curves)
        seen += curve.back().y < 1 ? 1 : 0;
      CHECK(seen > 20);
      CHECK(rig.avsm().statistics().segments == seen);
    }
}

TEST_CASE("avsm volumes: what comes through a grid is the integral of its trilinear density", "[sweep]") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 9;
  struct Case {
    glm::ivec3 size;
    float empty;
    GLenum format;
  };
  const std::vector<Case> cases = {{{1, 1, 1}, 0, GL_R8},          {{2, 2, 2}, 0.3F, GL_R16F},
                                   {{5, 3, 7}, 0.5F, GL_R16},      {{33, 17, 40}, 0.2F, GL_R32F},
                                   {{40, 40, 40}, 0.97F, GL_R32F}, {{2048, 1, 1}, 0.5F, GL_R8},
                                   {{1, 1, 300}, 0.1F, GL_R16F}};
  unsigned seed = 1;
  for (const Case& c : cases)
    for (const Shape shape : {Shape::Box, Shape::Sphere})
      for (const double fade : {0.0, 0.3}) {
        const DensityTexture texture(c.size, tests::noiseOf(c.size, c.empty, c.format, ++seed), c.format);
        const Mat4 place = placed({0.1, -0.05, 0.05}, {0.7, 0.6, 0.5}, 0.3 * (seed % 5));
        const std::vector<Fog> fog = {{volumeOf(shape, place, 6, fade, texture.texture.name()), texture.grid}};
        const Light light = seed % 3 == 0 ? parallelLight() : spotLight(seed % 3 == 1);
        AvsmRig rig(configOf(kSize));
        CAPTURE(c.size.x, c.size.z, fade, static_cast<int>(shape), seed);
        draw(rig, light, volumesOf(fog), false, 2);
        const Errors errors = errorsOf(rig, kSize, light, fog);
        CHECK(errors.whole < 1e-5);
        CHECK(errors.curve < 3e-3);
        AvsmRig streamed(configOf(kSize));
        draw(streamed, light, volumesOf(fog), true);
        CHECK(errorsOf(streamed, kSize, light, fog).whole < 1e-5);
      }
}

TEST_CASE("avsm volumes: empty and even bricks are stepped over, and nothing beside them is") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 16;
  const glm::ivec3 size(61, 45, 53);
  std::vector<float> values(static_cast<std::size_t>(size.x) * size.y * size.z, 0.0F);
  const auto at = [&](int x, int y, int z) -> float& {
    return values[static_cast<std::size_t>((z * size.y + y) * size.x + x)];
  };
  for (int z = 20; z < 37; ++z)
    for (int y = 8; y < 30; ++y)
      for (int x = 12; x < 37; ++x)
        at(x, y, z) = 0.5F;           // even within
  at(3, 40, 4) = at(60, 44, 52) = 30; // and two that stand alone, one in a corner
  at(47, 3, 7) = 20;
  const DensityTexture texture(size, values);
  for (const double fade : {0.0, 0.2})
    for (const Light& light : {parallelLight(), spotLight(false)}) {
      const std::vector<Fog> fog = {
          {volumeOf(Shape::Box, placed({0, 0, 0}, {0.9, 0.8, 0.7}, 0.2), 4, fade, texture.texture.name()),
           texture.grid}};
      AvsmRig rig(configOf(kSize));
      draw(rig, light, volumesOf(fog), false, 2);
      const Errors errors = errorsOf(rig, kSize, light, fog);
      CAPTURE(fade);
      CHECK(errors.whole < 1e-5);
      CHECK(errors.curve < 3e-3);
    }
}

TEST_CASE("avsm volumes: they overlap, stand around the light, behind it, behind the far plane or out of view") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8;
  const Light light = spotLight(false);
  const auto check = [&](const std::vector<Fog>& fog, bool seen) {
    AvsmRig rig(configOf(kSize));
    draw(rig, light, volumesOf(fog));
    const auto passes = rig.avsm().statistics().passes;
    const auto drawn = std::count_if(passes.begin(), passes.end(), [](const auto& p) { return p.name == "volumes"; });
    CHECK((drawn > 0) == seen);
    if (rig.avsm().curves().texture == 0) {
      CHECK_FALSE(seen);
      return;
    }
    const Errors errors = errorsOf(rig, kSize, light, fog, tests::depthOfSpot());
    CHECK(errors.whole < 1e-5);
  };
  const Fog sphere{volumeOf(Shape::Sphere, placed({0.1, 0, -1}, {0.8, 0.8, 0.8}), 1), {}};
  const Fog box{volumeOf(Shape::Box, placed({0, 0.2, -1.2}, {0.5, 0.5, 1}, 0.4), 2), {}};
  check({sphere, box, sphere}, true);
  check({{volumeOf(Shape::Sphere, placed({0, 0, 2}, {1, 1, 1}), 0.7), {}}}, true);   // around the light
  check({{volumeOf(Shape::Box, placed({0, 0, 0}, {20, 20, 20}), 0.2), {}}}, true);   // around all
  check({{volumeOf(Shape::Sphere, placed({0, 0, 4.5}, {1, 1, 1}), 1), {}}}, false);  // behind the light
  check({{volumeOf(Shape::Box, placed({0, 0, -9}, {1, 1, 1}), 1), {}}}, false);      // behind the far plane
  check({{volumeOf(Shape::Box, placed({9, 0, 0}, {0.5, 0.5, 0.5}), 1), {}}}, false); // beside the cone
  check({{volumeOf(Shape::Box, placed({0, 0, 0}, {1, 1, 1}), 0), {}}}, false);       // nothing in it
  check({}, false);
}

TEST_CASE("avsm volumes: each view has its own, in its layer") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8;
  Light light = parallelLight(); // two cascades, the second of them wider, and moved
  light.shadow.views.push_back({tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(0.6, 0.5, -0.7)) *
                                              glm::translate(glm::dmat4(1), glm::dvec3(0.3, -0.2, 0.1))),
                                1});
  const DensityTexture texture({9, 7, 8}, tests::noiseOf({9, 7, 8}, 0.2F, GL_R32F, 5));
  const std::vector<Fog> fog = {
      {volumeOf(Shape::Box, placed({0.1, 0.2, 0}, {0.7, -0.5, 0.4}, 0.5), 4, 0.2, texture.texture.name()),
       texture.grid},
      {volumeOf(Shape::Sphere, placed({-1.3, 0, 0.1}, {0.5, 0.6, 0.5}), 1), {}}}; // seen by the second alone
  AvsmConfig config = configOf(kSize);
  config.layers = 2;
  AvsmRig rig(config);
  draw(rig, light, volumesOf(fog), false, 2);
  for (const int view : {0, 1}) {
    const Errors errors = errorsOf(rig, kSize, light, fog, -1e9, view);
    CAPTURE(view);
    CHECK(errors.whole < 1e-5);
    CHECK(errors.curve < 3e-3);
  }
}

TEST_CASE("avsm volumes: what lies before the near plane dims light there, what lies behind it as far as it comes") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 6;
  const DensityTexture texture({20, 18, 22}, tests::noiseOf({20, 18, 22}, 0.2F, GL_R32F, 9));
  for (const std::uint32_t density : {0U, texture.texture.name()})
    for (const double fade : {0.0, 0.4}) {
      const std::vector<Fog> fog = {{volumeOf(Shape::Box, placed({0, 0, 1}, {2, 2, 1.3}, 0), 1, fade, density),
                                     density == 0 ? reference::DensityGrid{} : texture.grid}};
      AvsmRig rig(configOf(kSize));
      draw(rig, parallelLight(), volumesOf(fog), false, 2);
      const Errors errors = errorsOf(rig, kSize, parallelLight(), fog);
      CAPTURE(density, fade);
      CHECK(errors.whole < 1e-5);
      CHECK(errors.curve < 3e-3);
    }
}

TEST_CASE("avsm volumes: thick ones are as dark where they begin as they are") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 6;
  for (const double extinction : {30.0, 160.0, 2000.0})
    for (const double fade : {0.0, 0.5}) {
      const std::vector<Fog> fog = {
          {volumeOf(Shape::Sphere, placed({0, 0, 0}, {0.9, 0.9, 0.9}), extinction, fade), {}}};
      AvsmRig rig(configOf(kSize));
      draw(rig, parallelLight(), volumesOf(fog), false, 2);
      CAPTURE(extinction, fade);
      CHECK(errorsOf(rig, kSize, parallelLight(), fog).curve < 3e-3);
    }
}

TEST_CASE(
    "avsm volumes: rays that run along bricks' borders, and volumes that are small in a deep view, come to an end") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8; // texels' centres lie on borders of bricks
  std::vector<float> values = tests::noiseOf({64, 64, 64}, 0.5F, GL_R32F, 4);
  const DensityTexture texture({64, 64, 64}, values);
  Light light = parallelLight();
  for (const double tilt : {0.0, 4e-8, -4e-8}) {
    light.shadow.views[0].clipFromWorld[8] = light.shadow.views[0].clipFromWorld[9] = tilt;
    const std::vector<Fog> fog = {
        {volumeOf(Shape::Box, placed({0, 0, 0}, {1, 1, 1}), 1, 0, texture.texture.name()), texture.grid}};
    AvsmRig rig(configOf(kSize));
    draw(rig, light, volumesOf(fog), false, 2);
    CAPTURE(tilt);
    CHECK(errorsOf(rig, kSize, light, fog).whole < 1e-4);
  }
  for (const double place : {-1600.0, 900.0, -3400.0}) { // the last before the near plane
    light.shadow.views[0].clipFromWorld = tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(8, 8, 1.0 / 2500)) *
                                                        glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 0)));
    light.direction = {0, 0, 1};
    const std::vector<Fog> fog = {
        {volumeOf(Shape::Box, placed({0, 0, place}, {0.1, 0.1, 0.1}, 0.4), 12, 0, texture.texture.name()),
         texture.grid}};
    AvsmRig rig(configOf(kSize));
    draw(rig, light, volumesOf(fog), false, 2);
    CAPTURE(place);
    CHECK(errorsOf(rig, kSize, light, fog).whole < 2e-2); // floats place it to 1e-3 of its size
  }
}

TEST_CASE("avsm volumes: densities that are negative or no number are none, those without end let nothing through") {
  if (!tests::hasAvsm()) return;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const DensityTexture nothing({2, 2, 2}, {-1, kNan, -kInf, -0.0F, kNan, -5, kNan, -1});
  AvsmRig rig(configOf(4));
  draw(rig, parallelLight(), {volumeOf(Shape::Box, placed({0, 0, 0}, {1, 1, 1}), 3, 0, nothing.texture.name())});
  CHECK(rig.avsm().curves().texture == 0);
  const DensityTexture wall({1, 1, 3}, {0, kInf, 0});
  draw(rig, parallelLight(), {volumeOf(Shape::Box, placed({0, 0, 0}, {1, 1, 1}), 1e30, 0, wall.texture.name())});
  for (const Curve& curve : rig.map().curves)
    CHECK(curve.back().y == 0);
}

TEST_CASE("avsm volumes: a grid that changes is looked at again unless its version says that it is as it was") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(4));
  DensityTexture texture({8, 8, 8}, std::vector<float>(512, 0.0F));
  AvsmVolume volume = volumeOf(Shape::Box, placed({0, 0, 0}, {1, 1, 1}), 1, 0, texture.texture.name());
  const auto rangesMade = [&] {
    draw(rig, parallelLight(), {volume});
    const auto passes = rig.avsm().statistics().passes;
    return std::any_of(passes.begin(), passes.end(), [](const auto& p) { return p.name == "ranges"; });
  };
  CHECK(rangesMade());
  CHECK(rangesMade()); // version 0
  volume.version = 7;
  CHECK(rangesMade());
  CHECK_FALSE(rangesMade());
  const AvsmVolume known = volume;
  volume.density = 0;
  volume.extinction = 0;
  CHECK_FALSE(rangesMade()); // a frame without it,
  volume = known;
  CHECK_FALSE(rangesMade()); // and it is known still
  CHECK(rig.avsm().curves().texture == 0);
  texture.fill(std::vector<float>(512, 1.0F));
  volume.version = 8;
  CHECK(rangesMade());
  CHECK(rig.curve({1, 1, 0}).back().y == Approx(std::exp(-2.0)).margin(1e-5));
  CHECK_FALSE(rangesMade());
  CHECK(rig.curve({1, 1, 0}).back().y == Approx(std::exp(-2.0)).margin(1e-5));
}

TEST_CASE("avsm volumes: what breaks a rule is named, and draws nothing") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(4));
  const DensityTexture texture({2, 2, 2}, std::vector<float>(8, 1.0F));
  const AvsmVolume good = volumeOf(Shape::Box, placed({0, 0, 0}, {0.5, 0.5, 0.5}), 1, 0, texture.texture.name());
  const auto check = [&](const std::string& word, const Light& light, const std::vector<AvsmVolume>& volumes) {
    const Status status = rig.avsm().drawVolumes(light, volumes);
    INFO(status.message);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find(word) != std::string::npos);
    CHECK(status.message.find('\n') == std::string::npos);
  };
  check("drawVolumes needs a begin() or beginStreaming()", parallelLight(), {good});
  REQUIRE(rig.avsm().begin(2));
  const auto checkVolume = [&](const std::string& word, const auto& change) {
    AvsmVolume volume = good;
    change(volume);
    check("volumes[1]." + word, parallelLight(), {good, volume});
  };
  const double nan = std::nan("");
  checkVolume("shape is 2", [](AvsmVolume& v) { v.shape = static_cast<Shape>(2); });
  checkVolume("worldFromVolume is not finite", [&](AvsmVolume& v) { v.worldFromVolume[5] = nan; });
  checkVolume("worldFromVolume is singular", [](AvsmVolume& v) { v.worldFromVolume[0] = 0; });
  checkVolume("worldFromVolume is not affine", [](AvsmVolume& v) { v.worldFromVolume[3] = 0.5; });
  for (const double extinction : {-1.0, nan, kInfinity})
    checkVolume("extinction is", [&](AvsmVolume& v) { v.extinction = extinction; });
  for (const double fade : {-0.1, 1.1, nan})
    checkVolume("fade is", [&](AvsmVolume& v) { v.fade = fade; });
  checkVolume("density is texture 4000: not the name of a texture", [](AvsmVolume& v) { v.density = 4000; });
  const host::GlTexture flat = host::makeTexture2D(GL_R8, 2, 2);
  checkVolume("density is texture " + std::to_string(flat.name()) + ": must be a GL_TEXTURE_3D",
              [&](AvsmVolume& v) { v.density = flat.name(); });
  const auto checkTexture = [&](const std::string& rule, const auto& change) {
    const host::GlTexture other = host::makeTexture();
    gl().BindTexture(GL_TEXTURE_3D, other.name());
    change();
    gl().BindTexture(GL_TEXTURE_3D, 0);
    checkVolume("density is texture " + std::to_string(other.name()) + ": " + rule,
                [&](AvsmVolume& v) { v.density = other.name(); });
  };
  checkTexture("has no level 0", [] {});
  const auto allocate = [](GLenum format) {
    gl().TexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(format), 2, 2, 2, 0, GL_RED, GL_FLOAT, nullptr);
  };
  checkTexture("must have the format R8", [&] { allocate(GL_RGBA8); });
  checkTexture("GL_TEXTURE_BASE_LEVEL", [&] {
    allocate(GL_R8);
    gl().TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_BASE_LEVEL, 1);
  });
  checkTexture("GL_TEXTURE_SWIZZLE_R", [&] {
    allocate(GL_R8);
    gl().TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_SWIZZLE_R, GL_ONE);
  });
  check("volumes is 9 long", parallelLight(), std::vector<AvsmVolume>(9, good));
  Light light = parallelLight();
  light.shadow.views.clear();
  check("views.size() is 0", light, {good});
  REQUIRE(rig.avsm().resolve());
  CHECK(rig.avsm().curves().texture == 0);
}

TEST_CASE(
    "avsm volumes: a poisoned GL state is on return what it was on entry, and lists stay bound by StateMode::Leave") {
  if (!tests::hasAvsm()) return;
  const DensityTexture texture({6, 5, 4}, tests::noiseOf({6, 5, 4}, 0.3F, GL_R32F, 3));
  const std::vector<AvsmVolume> volumes = {
      volumeOf(Shape::Box, placed({0, 0, 0}, {0.7, 0.6, 0.5}, 0.3), 3, 0.2, texture.texture.name()),
      volumeOf(Shape::Sphere, placed({0.2, 0, 0}, {0.5, 0.6, 0.5}), 1)};
  AvsmRig rig(configOf(9)), poisoned(configOf(9));
  draw(rig, parallelLight(), volumes);
  Status drawn;
  tests::GlState before, after;
  REQUIRE(poisoned.avsm().begin(2));
  {
    const tests::Poison poison;
    before = tests::captureGlState();
    drawn = poisoned.avsm().drawVolumes(parallelLight(), volumes);
    after = tests::captureGlState();
    tests::Poison::lift();
  }
  INFO(drawn.message);
  CHECK(drawn);
  REQUIRE(poisoned.avsm().resolve());
  for (const auto& [name, values] : before) {
    CAPTURE(name);
    CHECK(after.at(name) == values);
  }
  CHECK(poisoned.bits() == rig.bits());

  AvsmConfig config = configOf(9);
  config.state = StateMode::Leave;
  AvsmRig leaving(config);
  tests::captureInto(leaving.avsm(), {}); // begin(2)
  before = tests::captureGlState();
  CHECK(leaving.avsm().drawVolumes(parallelLight(), volumes));
  after = tests::captureGlState();
  for (const auto& [name, values] : before) {
    const bool isList = name.find("storage binding") == 0 &&
                        (name.find("[2]") != std::string::npos || name.find("[3]") != std::string::npos);
    const bool isEmpty =
        name == "shader storage buffer" || (name.find("image " + std::to_string(GL_IMAGE_BINDING_NAME)) == 0 &&
                                            name.back() == ']' && name.find("[0]") != std::string::npos);
    CAPTURE(name);
    if (isList) CHECK(after.at(name) == values);
    if (isEmpty) CHECK(after.at(name) == std::vector<double>{0});
  }
  REQUIRE(leaving.avsm().resolve());
  CHECK(leaving.bits() == rig.bits());
}
