// The way of an engine: world positions to depths by avsmDepth(), and fragments that capture or insert smoke.
#include "AvsmRig.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;
using tests::AvsmRig;

namespace {

Light lightOf(const glm::dmat4& clipFromView, bool directional, ClipDepth clipDepth) {
  Light light;
  light.kind = directional ? LightKind::Directional : LightKind::Spot;
  light.position = {1, 2, 3};
  light.direction = {0, 0, -1};
  light.shadow.clipDepth = clipDepth;
  light.shadow.views = {{tests::toMat4(clipFromView * glm::translate(glm::dmat4(1), glm::dvec3(-1, -2, -3))), 0}};
  return light;
}

// z of clip space mapped to [0, 1], and turned round.
glm::dmat4 converted(const glm::dmat4& projection, ClipDepth clipDepth, bool reversed) {
  glm::dmat4 m(1);
  if (clipDepth == ClipDepth::ZeroToOne) {
    m[2][2] = reversed ? -0.5 : 0.5;
    m[3][2] = 0.5;
  } else if (reversed) {
    m[2][2] = -1;
  }
  return m * projection;
}

} // namespace

TEST_CASE("avsm: depth is linear from the near to the far plane of any projection") {
  constexpr double kNear = 0.5, kFar = 20;
  for (const bool directional : {true, false})
    for (const bool reversed : {false, true})
      for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
        const glm::dmat4 projection =
            directional ? glm::ortho(-2.0, 2.0, -2.0, 2.0, kNear, kFar) : glm::perspective(1.0, 1.0, kNear, kFar);
        const Light light = lightOf(converted(projection, clipDepth, reversed), directional, clipDepth);
        std::array<double, 4> depth{};
        REQUIRE(avsmDepth(light, 0, depth));
        CAPTURE(directional, reversed, static_cast<int>(clipDepth));
        for (const double along : {kNear, 3.0, 10.0, kFar})
          for (const double side : {-1.0, 0.5})
            CHECK(depth[0] * (1 + side) + depth[1] * (2 - side) + depth[2] * (3 - along) + depth[3] ==
                  Approx((along - kNear) / (kFar - kNear)).margin(1e-9));
      }
}

TEST_CASE("avsm: depth is refused of a light that has none") {
  const glm::dmat4 projection = glm::perspective(1.0, 1.0, 0.5, 20.0);
  const Light light = lightOf(projection, false, ClipDepth::NegativeOneToOne);
  std::array<double, 4> depth{};
  const auto check = [&](const Light& asked, int view, const std::string& rule) {
    const Status status = avsmDepth(asked, view, depth);
    INFO(status.message);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find("view is " + std::to_string(view) + ": ") == 0);
    CHECK(status.message.find(rule) != std::string::npos);
  };
  for (const int view : {-1, 1})
    check(light, view, "the light has 1 shadow views");
  Light bad = light;
  bad.shadow.views[0].clipFromWorld = {};
  check(bad, 0, "must be invertible");
  bad = light;
  bad.shadow.views[0].clipFromWorld[3] = std::nan("");
  check(bad, 0, "must be invertible");
  check(lightOf(glm::infinitePerspective(1.0, 1.0, 0.5), false, ClipDepth::NegativeOneToOne), 0,
        "must not be at infinity");
  bad = light;
  bad.position[1] = kInfinity;
  check(bad, 0, "must be finite");
  bad.kind = LightKind::Directional;
  CHECK(avsmDepth(bad, 0, depth));
  bad.direction = {0, 0, 0};
  check(bad, 0, "must have a length");
}

TEST_CASE("avsm: fragments capture what an engine draws from the light's view") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 16, kPlanes = 20;
  const std::string fragment =
      std::string("#version 430 core\n") + avsmCaptureSource() +
      "in float depth;\nvoid main() { tyndallCapture(ivec3(gl_FragCoord.xy, 0), depth, depth + 0.02, 0.9); }\n";
  // Planes one behind the other over the left half of the map.
  const char* vertex =
      "#version 430 core\nout float depth;\nvoid main() {\n"
      "  depth = 0.1 + 0.04 * float(gl_InstanceID);\n"
      "  gl_Position = vec4((gl_VertexID & 1) == 0 ? -1 : 0, (gl_VertexID & 2) == 0 ? -1 : 1, 0, 1);\n}\n";
  host::Program program("capture", vertex, fragment.c_str());
  const host::GlVertexArray empty = host::makeVertexArray();
  const host::GlTexture target = host::makeTexture2D(GL_RGBA8, kSize, kSize);
  const host::GlFramebuffer framebuffer = host::makeFramebuffer();
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
  AvsmConfig config;
  config.size = kSize;
  AvsmRig rig(config);
  for (int frame = 0; frame < 3; ++frame) {
    REQUIRE(rig.avsm().begin());
    gl().BindVertexArray(empty.name());
    gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl().Viewport(0, 0, kSize, kSize);
    program.use();
    gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, kPlanes);
    REQUIRE(rig.avsm().resolve());
    gl().Finish();
  }
  gl().UseProgram(0);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl().BindVertexArray(0);
  CHECK(rig.avsm().statistics().segments == kPlanes * kSize * kSize / 2);
  CHECK(rig.avsm().statistics().lost == 0);
  for (int i = 0; i < kSize * kSize; ++i) {
    const double passed = i % kSize < kSize / 2 ? std::pow(0.9, kPlanes) : 1;
    CHECK(rig.curve({i % kSize, i / kSize, 0}).back().y == Approx(passed).margin(2e-5));
  }
}
