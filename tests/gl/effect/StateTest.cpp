// The contract with an engine: GL state on return equals GL state on entry, of refused frames too, and textures keep
// their parameters. What states an engine may leave behind: HostileRows.cpp.
#include "GlState.h"
#include "gl/ReadBack.h"
#include "support/EffectRig.h"

#include <catch2/catch.hpp>

using namespace tyndall;
using host::gl;

namespace {

std::vector<GLint> parametersOf(GLenum target, GLuint texture) {
  std::vector<GLint> values;
  gl().BindTexture(target, texture);
  for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER, GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T,
                            GL_TEXTURE_WRAP_R, GL_TEXTURE_COMPARE_MODE, GL_TEXTURE_COMPARE_FUNC, GL_TEXTURE_BASE_LEVEL,
                            GL_TEXTURE_MAX_LEVEL, GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_A}) {
    GLint value = 0;
    gl().GetTexParameteriv(target, name, &value);
    values.push_back(value);
  }
  for (const GLenum name : {GL_TEXTURE_MIN_LOD, GL_TEXTURE_MAX_LOD, GL_TEXTURE_LOD_BIAS}) {
    GLfloat value = 0;
    gl().GetTexParameterfv(target, name, &value);
    values.push_back(static_cast<GLint>(value * 16));
  }
  return values;
}

// A frame that takes every kind of pass: two lights, a shadow array in compare mode, glass, outputs and a composite.
struct FullFrame {
  tests::FrameRig rig{16, 16, std::vector<float>(256, 0.5F)};
  tests::ShadowRig shadow;
  host::GlTexture colour = host::makeTexture2D(GL_RGBA16F, 16, 16);

  FullFrame() {
    Frame& frame = rig.frame;
    frame.colour = colour.name();
    frame.camera.clipFromView = tests::reversedInfinite(1, 1, 0.1);
    frame.camera.clipDepth = ClipDepth::ZeroToOne;
    frame.medium.constituents = {{{0.1F, 0.2F, 0.3F}, Phase::Rayleigh, 0}};
    frame.lights.resize(2);
    frame.lights[0].shadow.views = {{kIdentity, 1}};
    frame.lights[1].kind = LightKind::Point;
    frame.lights[1].position = {0, 1, -2};
    shadow.image = {4, 4, 2, std::vector<float>(32, 0.5F), std::vector<float>(96, 0.7F), std::vector<float>(32, 0.2F)};
    shadow.upload(frame.lights[0]);
    gl().BindTexture(GL_TEXTURE_2D_ARRAY, shadow.depth.name());
    gl().TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl().TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl().TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT);
  }
};

// Renders; every row of the state must be afterwards what it was.
void checkStateKept(const Frame& frame, bool valid = true) {
  const tests::Poison poison;
  const tests::GlState before = tests::captureGlState();
  const Status status = tests::testEffect().render(frame);
  const tests::GlState after = tests::captureGlState();
  tests::Poison::lift();
  INFO(status.message);
  CHECK(static_cast<bool>(status) == valid);
  for (const auto& [name, values] : before) {
    INFO(name);
    CHECK(values == after.at(name));
  }
}

} // namespace

TEST_CASE("GL state on return equals GL state on entry, every row of it poisoned") {
  tests::testEffect();
  FullFrame full;
  const reference::ImageAnswer expected = full.rig.render();
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar})
    for (const bool outputs : {true, false})
      for (const bool valid : {true, false}) {
        Frame frame = full.rig.frame;
        frame.settings.technique = technique;
        if (!outputs) frame.output = {};
        if (!valid) frame.depth.texture = full.colour.name();
        checkStateKept(frame, valid);
      }
  // The poison did not get into the picture either.
  const reference::ImageAnswer again = full.rig.render();
  CHECK(again.inscatter.rgb == expected.inscatter.rgb);
}

TEST_CASE("frames that reuse the last one leave a poisoned GL state alone") {
  FullFrame full;
  const host::GlBuffer vertices = host::makeBuffer();
  host::gl().BindBuffer(GL_ARRAY_BUFFER, vertices.name());
  constexpr std::array<float, 9> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 1};
  host::gl().BufferData(GL_ARRAY_BUFFER, sizeof kTriangle, kTriangle.data(), GL_STATIC_DRAW);
  Frame frame = full.rig.frame;
  frame.settings.technique = Technique::Epipolar;
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const View view : {View::Composite, View::Redrawn})
      for (int number = 0; number < 4; ++number) { // all, parts of it, nothing
        frame.settings.view = view;
        frame.reuse = {changes, 71, static_cast<std::uint64_t>(number), 1.0F, 0};
        frame.objects.clear();
        if (changes == Changes::Objects && number < 3) frame.objects.assign(1, {});
        if (!frame.objects.empty() && number > 0) frame.objects[0].mesh = {vertices.name(), 0, 12, 3, 0};
        CAPTURE(static_cast<int>(changes), static_cast<int>(view), number);
        checkStateKept(frame);
      }
}

TEST_CASE("parameters of the engine's textures are not touched") {
  FullFrame full;
  const Light& light = full.rig.frame.lights[0];
  const std::vector<std::pair<GLenum, GLuint>> textures = {
      {GL_TEXTURE_2D, full.rig.frame.depth.texture},    {GL_TEXTURE_2D, full.colour.name()},
      {GL_TEXTURE_2D, full.rig.frame.output.inscatter}, {GL_TEXTURE_2D_ARRAY, light.shadow.texture},
      {GL_TEXTURE_2D_ARRAY, light.glass.colour},        {GL_TEXTURE_2D_ARRAY, light.glass.depth}};
  std::vector<std::vector<GLint>> before;
  for (const auto& [target, name] : textures)
    before.push_back(parametersOf(target, name));
  full.rig.render();
  for (std::size_t i = 0; i < textures.size(); ++i)
    CHECK(parametersOf(textures[i].first, textures[i].second) == before[i]);
}
