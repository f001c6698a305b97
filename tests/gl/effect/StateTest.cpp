// The contract with an engine: GL state on return equals GL state on entry, of refused frames too, and textures keep
// their parameters. What states an engine may leave behind: HostileRows.cpp.
#include "FakeContext.h"
#include "GlState.h"
#include "LegacyState.h"
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

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
    frame.lights[0].direction = {0, 0, 1};
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

TEST_CASE("GL state on return equals GL state on entry, every row of it poisoned", "[compatibility]") {
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
  CHECK(again.inscatter == expected.inscatter);
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
    for (const DebugView view : {DebugView::Composite, DebugView::Redrawn})
      for (int number = 0; number < 4; ++number) { // all, parts of it, nothing
        frame.settings.debugView = view;
        frame.reuse = {changes, 71, static_cast<std::uint64_t>(number), 1.0F, 0};
        frame.objects.clear();
        if (changes == Changes::Objects && number < 3) frame.objects.assign(1, {});
        if (!frame.objects.empty() && number > 0) frame.objects[0].mesh = {vertices.name(), 0, 12, 3, 0};
        CAPTURE(static_cast<int>(changes), static_cast<int>(view), number);
        checkStateKept(frame);
      }
}

namespace {

// What the header says of StateMode::Leave, over a state that was there before.
tests::GlState left(tests::GlState state, const Frame& frame) {
  for (const char* row :
       {"program",         "vertex array",      "draw framebuffer",   "renderbuffer",       "pixel unpack buffer",
        "uniform buffer",  "unpack row length", "unpack skip rows",   "unpack skip pixels", "unpack swap bytes",
        "blend",           "cull face",         "depth test",         "stencil test",       "scissor test",
        "dither",          "logic op",          "rasterizer discard", "framebuffer sRGB",   "sample mask",
        "sample coverage", "alpha to coverage", "alpha to one",       "polygon smooth",     "clip distance 0",
        "clip distance 7", "stencil ref",       "stencil back ref"})
    state.at(row) = {0};
  state.at("active texture") = {GL_TEXTURE0};
  state.at("unpack alignment") = {4};
  state.at("polygon mode").at(0) = GL_FILL;
  if (state.count("clip origin") != 0) {
    state.at("clip origin") = {GL_LOWER_LEFT};
    state.at("clip depth mode") = {GL_NEGATIVE_ONE_TO_ONE};
  }
  state.at("viewport") = {0, 0, static_cast<double>(frame.viewport.width), static_cast<double>(frame.viewport.height)};
  for (const std::string face : {"stencil ", "stencil back "}) {
    state.at(face + "func") = {GL_ALWAYS};
    state.at(face + "value mask") = state.at(face + "write mask") = {2147483647.0}; // all bits, as an integer
    state.at(face + "fail") = state.at(face + "pass") = {GL_KEEP};
  }
  state.at("stencil depth fail") = {GL_KEEP};
  for (const auto& [row, values] : tests::leftLegacyState())
    state.at(row) = values;
  return state;
}

bool startsWith(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

// Of rows that there are several of.
std::vector<double> leftOf(const std::string& row, const std::vector<double>& before, const Frame& frame) {
  const auto query = [&](GLenum name) { return startsWith(row, "blend " + std::to_string(name)); };
  if (startsWith(row, "colour mask")) return {1, 1, 1, 1};
  if (startsWith(row, "blend[") || startsWith(row, "scissor[")) return {0};
  if (query(GL_BLEND_SRC_RGB) || query(GL_BLEND_SRC_ALPHA)) return {GL_ONE};
  if (query(GL_BLEND_DST_RGB) || query(GL_BLEND_DST_ALPHA)) return {GL_ZERO};
  if (query(GL_BLEND_EQUATION_RGB) || query(GL_BLEND_EQUATION_ALPHA)) return {GL_FUNC_ADD};
  if (row == "viewport[0]")
    return {0, 0, static_cast<double>(frame.viewport.width), static_cast<double>(frame.viewport.height)};
  for (const char* binding : {"[0]", "[1]", "[2]"})
    if (startsWith(row, "uniform binding") && row.find(binding) != std::string::npos) return {0};
  return before;
}

bool isOfUnit(const std::string& row) { return startsWith(row, "unit "); }

} // namespace

TEST_CASE("with StateMode::Leave the state is as the header says, whatever it was, and nothing else of it changed",
          "[compatibility]") {
  FullFrame full;
  for (const bool multiBind : {true, false}) {
    const tests::FakeContext fake(multiBind ? std::set<std::string>{} : std::set<std::string>{"glBindTextures"});
    const std::unique_ptr<Effect> created = tests::newEffect({fake.loader(), PassTiming::Off, {}, StateMode::Leave});
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
      CAPTURE(multiBind, static_cast<int>(technique));
      Frame frame = full.rig.frame;
      frame.settings.technique = technique;
      const tests::Poison poison;
      const tests::GlState before = tests::captureGlState();
      const Status status = created->render(frame);
      const tests::GlState after = tests::captureGlState();
      tests::Poison::lift();
      CHECK(status);
      std::size_t emptied = 0;
      for (const auto& [row, values] : left(before, frame)) {
        CAPTURE(row);
        if (isOfUnit(row)) { // as many as it used
          const bool isEmpty = after.at(row) == std::vector<double>{0};
          emptied += isEmpty && values != after.at(row) ? 1 : 0;
          CHECK((isEmpty || values == after.at(row)));
        } else {
          CHECK(after.at(row) == leftOf(row, values, frame));
        }
      }
      CHECK(emptied > 0);
    }
  }
}

TEST_CASE("with StateMode::Leave the picture is that of StateMode::Restore, whatever the state was",
          "[compatibility]") {
  FullFrame full;
  const auto picture = [&] { return host::readColour(full.rig.frame.output.inscatter, 16, 16); };
  full.rig.render();
  const std::vector<float> expected = picture();
  const std::unique_ptr<Effect> created = tests::newEffect({{}, PassTiming::Off, {}, StateMode::Leave});
  for (int i = 0; i < 2; ++i) {
    const tests::Poison poison;
    const Status status = created->render(full.rig.frame);
    tests::Poison::lift();
    CHECK(status);
    CHECK(tests::bitEqual(picture(), expected));
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

TEST_CASE("a current program that the engine has deleted leaves no GL error behind") {
  FullFrame full;
  for (const bool valid : {true, false}) {
    const GLuint program = gl().CreateProgram();
    const GLuint shader = gl().CreateShader(GL_VERTEX_SHADER);
    const char* const text = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    gl().ShaderSource(shader, 1, &text, nullptr);
    gl().CompileShader(shader);
    gl().AttachShader(program, shader);
    gl().LinkProgram(program);
    gl().UseProgram(program);
    gl().DeleteProgram(program); // which stays current until another is
    gl().DeleteShader(shader);
    Frame frame = full.rig.frame;
    if (!valid) frame.viewport.width = 0;
    CHECK(static_cast<bool>(tests::testEffect().render(frame)) == valid);
    CHECK(gl().GetError() == GL_NO_ERROR);
    GLint current = 0;
    gl().GetIntegerv(GL_CURRENT_PROGRAM, &current);
    CHECK(current == (valid ? 0 : static_cast<GLint>(program)));
    gl().UseProgram(0);
  }
}
