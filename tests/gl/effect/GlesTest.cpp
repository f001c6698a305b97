// OpenGL ES 3.2: the same sources draw the pictures of the core profile, with what a context has by extension and
// without it; state is given back; what a context lacks is said by create(). The tests' context is one of ES, made by
// EGL.
#include "EmbeddedPrograms.h"
#include "FakeContext.h"
#include "FrameCases.h"
#include "Mistakes.h"
#include "ShaftRig.h"
#include "gl/Objects.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <scene/Error.h>
#include <set>
#include <tyndall/avsm.h>

using namespace tyndall;
using host::gl;
using tests::address;
using tests::FakeContext;

namespace {

struct Contexts {
  std::unique_ptr<host::Context> core = host::Context::create(host::ContextKind::Egl);
  host::Context& embedded = tests::testContext();
};

// In parts of what a half float keeps of the larger value; beside values under 1/16 of the largest, of that.
double worstRounding(const std::vector<float>& got, const std::vector<float>& wanted) {
  REQUIRE(got.size() == wanted.size());
  float largest = 0;
  for (const float value : wanted)
    largest = std::max(largest, std::abs(value));
  double worst = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double scale = std::max(std::abs(wanted[i]), largest / 16);
    const double error = std::abs(static_cast<double>(got[i]) - wanted[i]);
    if (error > 0) worst = std::max(worst, error / (scale * 0x1p-11));
    if (std::isnan(got[i]) != std::isnan(wanted[i])) worst = kInfinity;
  }
  return worst;
}

// A case's frames: what its reuse goes on from, and the last.
std::vector<tests::TargetContents> drawCase(const tests::FrameCase& item, GlLoader loader) {
  tests::Stage stage(item, 32, 24, tests::RigContext::Current);
  const std::unique_ptr<Effect> effect = tests::newEffect(tests::configFor(item, loader, PassTiming::Off));
  std::vector<tests::TargetContents> pictures;
  const int frames = item.changes == Changes::Unknown ? 1 : item.before + 1;
  for (int i = 0; i < frames; ++i) {
    if (i > 0) stage.advance();
    pictures.push_back(stage.draw(*effect));
  }
  return pictures;
}

void checkSame(const std::vector<tests::TargetContents>& got, const std::vector<tests::TargetContents>& wanted,
               double& worst) {
  REQUIRE(got.size() == wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i)
    for (std::size_t target = 0; target < got[i].size(); ++target) {
      CAPTURE(i, target);
      const double rounding = worstRounding(got[i][target], wanted[i][target]);
      CHECK(rounding <= 2);
      worst = std::max(worst, rounding);
    }
}

// --- extensions that a context seems to lack

std::set<std::string> hiddenExtensions;

const GLubyte* GLAD_API_PTR getStringi(GLenum name, GLuint index) {
  const GLubyte* text = gl().GetStringi(name, index);
  const bool isHidden = name == GL_EXTENSIONS && text && hiddenExtensions.count(reinterpret_cast<const char*>(text));
  return isHidden ? reinterpret_cast<const GLubyte*>("GL_EXT_nothing") : text;
}

struct Without {
  explicit Without(std::set<std::string> extensions) { hiddenExtensions = std::move(extensions); }
  ~Without() { hiddenExtensions.clear(); }
  Without(const Without&) = delete;
  Without& operator=(const Without&) = delete;
  FakeContext fake{{}, {{"glGetStringi", address(getStringi)}}};
};

void GLAD_API_PTR sayVersion31(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MINOR_VERSION) *value = 1;
}

// --- rows of the state that OpenGL ES has

using Rows = std::map<std::string, std::vector<GLint>>;

Rows embeddedState() {
  Rows rows;
  const auto add = [&](const std::string& name, GLenum query, std::size_t count = 1) {
    std::vector<GLint> values(16);
    gl().GetIntegerv(query, values.data());
    rows[name].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  };
  for (const GLenum capability :
       {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_DITHER, GL_RASTERIZER_DISCARD,
        GL_SAMPLE_MASK, GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_POLYGON_OFFSET_FILL,
        GL_PRIMITIVE_RESTART_FIXED_INDEX})
    rows["capability " + std::to_string(capability)] = {gl().IsEnabled(capability)};
  for (const GLenum query : {GL_CURRENT_PROGRAM,
                             GL_VERTEX_ARRAY_BINDING,
                             GL_ARRAY_BUFFER_BINDING,
                             GL_DRAW_FRAMEBUFFER_BINDING,
                             GL_READ_FRAMEBUFFER_BINDING,
                             GL_RENDERBUFFER_BINDING,
                             GL_PIXEL_UNPACK_BUFFER_BINDING,
                             GL_PIXEL_PACK_BUFFER_BINDING,
                             GL_UNIFORM_BUFFER_BINDING,
                             GL_COPY_READ_BUFFER_BINDING,
                             GL_ACTIVE_TEXTURE,
                             GL_DEPTH_FUNC,
                             GL_STENCIL_FUNC,
                             GL_STENCIL_REF,
                             GL_STENCIL_VALUE_MASK,
                             GL_STENCIL_WRITEMASK,
                             GL_STENCIL_FAIL,
                             GL_STENCIL_BACK_FUNC,
                             GL_STENCIL_BACK_WRITEMASK,
                             GL_UNPACK_ALIGNMENT,
                             GL_UNPACK_ROW_LENGTH,
                             GL_UNPACK_SKIP_ROWS,
                             GL_UNPACK_SKIP_PIXELS,
                             GL_PACK_ALIGNMENT,
                             GL_PACK_ROW_LENGTH,
                             GL_BLEND_SRC_RGB,
                             GL_BLEND_DST_ALPHA,
                             GL_BLEND_EQUATION_RGB,
                             GL_CULL_FACE_MODE,
                             GL_FRONT_FACE})
    add("integer " + std::to_string(query), query);
  add("viewport", GL_VIEWPORT, 4);
  add("scissor box", GL_SCISSOR_BOX, 4);
  add("colour mask", GL_COLOR_WRITEMASK, 4);
  GLint active = 0;
  gl().GetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLenum unit = 0; unit < 16; ++unit) {
    gl().ActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum query : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                               GL_TEXTURE_BINDING_CUBE_MAP, GL_SAMPLER_BINDING})
      add("unit " + std::to_string(unit) + " " + std::to_string(query), query);
  }
  gl().ActiveTexture(static_cast<GLenum>(active));
  for (GLuint i = 0; i < 4; ++i)
    for (const GLenum query :
         {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_EQUATION_ALPHA, GL_UNIFORM_BUFFER_BINDING}) {
      GLint value = 0;
      gl().GetIntegeri_v(query, i, &value);
      rows["buffer " + std::to_string(i) + " " + std::to_string(query)] = {value};
    }
  return rows;
}

// What would keep draws from being drawn, or tables from being uploaded.
struct EmbeddedPoison {
  std::vector<host::GlTexture> textures;
  host::GlSampler sampler = host::makeSampler();
  host::GlBuffer buffer = host::makeBuffer();

  EmbeddedPoison() {
    for (GLenum unit = 0; unit < 16; ++unit) {
      gl().ActiveTexture(GL_TEXTURE0 + unit);
      textures.push_back(host::makeTexture2D(GL_RGBA16F, 1, 1));
      textures.push_back(host::makeTextureArray(GL_RGBA16F, 1, 1, 2));
      gl().BindSampler(unit, sampler.name());
    }
    for (const GLenum capability :
         {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_RASTERIZER_DISCARD,
          GL_SAMPLE_MASK, GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_COVERAGE})
      gl().Enable(capability);
    gl().CullFace(GL_FRONT_AND_BACK);
    gl().DepthFunc(GL_NEVER);
    gl().StencilFunc(GL_NEVER, 3, 0x55);
    gl().StencilMask(0x3);
    gl().Scissor(1, 1, 2, 2);
    gl().Viewport(1, 2, 3, 5);
    gl().ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    gl().BlendFuncSeparate(GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR);
    gl().BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    gl().BlendFuncSeparatei(1, GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_DST_ALPHA);
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_PACK_ROW_LENGTH})
      gl().PixelStorei(name, 3);
    gl().BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.name());
    gl().BindBuffer(GL_PIXEL_PACK_BUFFER, buffer.name());
    gl().BindBufferBase(GL_UNIFORM_BUFFER, 1, buffer.name());
  }
  EmbeddedPoison(const EmbeddedPoison&) = delete;
  EmbeddedPoison& operator=(const EmbeddedPoison&) = delete;

  ~EmbeddedPoison() {
    for (GLuint unit = 0; unit < 16; ++unit)
      gl().BindSampler(unit, 0);
    gl().ActiveTexture(GL_TEXTURE0);
    for (const GLenum capability :
         {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_RASTERIZER_DISCARD,
          GL_SAMPLE_MASK, GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_COVERAGE})
      gl().Disable(capability);
    gl().DepthFunc(GL_LESS);
    gl().StencilFunc(GL_ALWAYS, 0, ~0U);
    gl().StencilMask(~0U);
    gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl().BlendFunc(GL_ONE, GL_ZERO);
    gl().BlendEquation(GL_FUNC_ADD);
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_PACK_ROW_LENGTH})
      gl().PixelStorei(name, 0);
    gl().BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl().BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  }
};

} // namespace

TEST_CASE("OpenGL ES draws what the core profile does: all frames", "[gles][once]") {
  Contexts contexts;
  double worst = 0;
  for (const tests::FrameCase& item : tests::frameCases()) {
    if (item.curves || item.smoke) continue; // an AVSM needs OpenGL 4.3
    CAPTURE(item.name);
    contexts.core->makeCurrent();
    const std::vector<tests::TargetContents> wanted = drawCase(item, contexts.core->loader());
    contexts.embedded.makeCurrent();
    checkSame(drawCase(item, contexts.embedded.loader()), wanted, worst);
  }
  CHECK(contexts.core->takeErrors().empty());
  std::printf("worst difference: %.3g of a half float's rounding\n", worst);
}

TEST_CASE("OpenGL ES draws what the core profile does: cascades that fade", "[gles][once]") {
  Contexts contexts;
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    std::vector<float> pictures[2];
    for (host::Context* context : {contexts.core.get(), &contexts.embedded}) {
      context->makeCurrent();
      tests::ShaftRig rig(48, 32, tests::RigContext::Current);
      Light sun = tests::shaftLight(LightKind::Directional);
      sun.shadow.views = tests::shadowViews(sun, 3);
      sun.cascadeFade = 0.1;
      rig.addLight(sun, 64, true);
      rig.scene.frame.settings.technique = technique;
      const std::unique_ptr<Effect> effect = tests::newEffect({context->loader()});
      REQUIRE(effect->render(rig.scene.frame));
      pictures[context == &contexts.embedded] = host::readColour(rig.scene.frame.output.inscatter, 48, 32);
    }
    CHECK(worstRounding(pictures[1], pictures[0]) <= 2);
  }
  CHECK(contexts.core->takeErrors().empty());
}

TEST_CASE("OpenGL ES: a state that is poisoned is given back, and is not in the picture", "[gles][once]") {
  tests::testContext();
  for (const char* name : {"epipolar", "tree, two lights, all targets", "exact, two lights", "low rank",
                           "detect, two lights, by the stencil, fix-up by tiles", "view 6"})
    for (const StateMode mode : {StateMode::Restore, StateMode::Leave}) {
      CAPTURE(name, static_cast<int>(mode));
      const tests::FrameCase& item = tests::frameCase(name);
      tests::Stage stage(item);
      Config config = tests::configFor(item, tests::testContext().loader(), PassTiming::Off);
      const tests::TargetContents expected = stage.draw(*tests::newEffect(config));
      config.state = mode;
      const std::unique_ptr<Effect> effect = tests::newEffect(config);
      stage.rewind();
      stage.fill();
      {
        const EmbeddedPoison poison;
        const Rows before = embeddedState();
        const Status status = effect->render(stage.frame());
        INFO(status.message);
        CHECK(status);
        static_cast<void>(effect->statistics());
        const Rows after = embeddedState();
        for (const auto& [row, values] : before) {
          CAPTURE(row);
          if (mode == StateMode::Restore) CHECK(after.at(row) == values);
        }
      }
      CHECK(stage.read() == expected);
    }
}

TEST_CASE("OpenGL ES: what a frame gets wrong is said, and nothing is drawn", "[gles][once]") {
  tests::Stage stage(tests::frameCase("epipolar, both outputs"));
  Effect& effect = tests::testEffect();
  stage.fill();
  const tests::TargetContents before = stage.read();
  const auto refuse = [&](const std::string& words, const std::function<void(Frame&)>& change) {
    CAPTURE(words);
    Frame frame = stage.frame();
    change(frame);
    const Status status = effect.render(frame);
    CAPTURE(status.message);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find(words) != std::string::npos);
    CHECK(stage.read() == before);
    tests::testContext().takeErrors(); // the debug messages of a binding that the check tried
  };
  const host::GlTexture array = host::makeTextureArray(GL_RGBA32F, 32, 24, 2);
  const host::GlTexture unrenderable = host::makeTexture2D(GL_RGB32F, 32, 24);
  refuse("Frame::output.inscatter is texture", [](Frame& f) { f.output.inscatter = 9999; });
  refuse("must be a GL_TEXTURE_2D", [&](Frame& f) { f.output.inscatter = array.name(); });
  refuse("must have a depth format", [&](Frame& f) { f.depth.texture = f.output.inscatter; });
  refuse("Frame::output: this context cannot render to the texture's format",
         [&](Frame& f) { f.output.inscatter = unrenderable.name(); });
  refuse("GL_TEXTURE_SWIZZLE_G must be GL_GREEN", [&](Frame& f) {
    static const host::GlTexture swizzled = host::makeTexture2D(GL_RGBA32F, 32, 24);
    gl().BindTexture(GL_TEXTURE_2D, swizzled.name());
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, GL_ZERO);
    f.output.inscatter = swizzled.name();
  });
}

TEST_CASE("OpenGL ES: inputs are checked by their pixels, too", "[gles][once]") {
  Config config{tests::testContext().loader()};
  config.checkInputs = true;
  const std::unique_ptr<Effect> effect = tests::newEffect(config);
  tests::ShaftRig rig = tests::rightRig(LightKind::Directional);
  const auto warnings = [&] {
    for (int i = 0; i < 3; ++i) {
      REQUIRE(effect->render(rig.scene.frame));
      gl().Finish();
    }
    return effect->statistics().warnings;
  };
  CHECK(warnings().empty());
  rig.scene.frame.camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1}); // depth is another's
  REQUIRE_FALSE(warnings().empty());
  CHECK(warnings()[0].find("Frame::lights[0].shadow: ") == 0);
}

TEST_CASE("OpenGL ES: what a context lacks has another way, or is said by create", "[gles][once]") {
  const tests::FrameCase& item = tests::frameCase("epipolar, bilinear and glass");
  const std::vector<tests::TargetContents> wanted = drawCase(item, tests::testContext().loader());
  double worst = 0;
  for (const char* extension :
       {"GL_EXT_blend_func_extended", "GL_EXT_texture_norm16", "GL_EXT_disjoint_timer_query", "GL_EXT_clip_control",
        "GL_EXT_clip_cull_distance", "GL_OES_viewport_array", "GL_KHR_parallel_shader_compile"}) {
    CAPTURE(extension);
    const Without without({extension});
    const auto created = without.fake.create();
    INFO(created.status.message);
    REQUIRE(created.effect);
    const bool hasDualSource = std::string(extension) != "GL_EXT_blend_func_extended";
    CHECK((created.effect->statistics().tuning.compositing == Compositing::DualSource) == hasDualSource);
    checkSame(drawCase(item, without.fake.loader()), wanted, worst);
  }
  const auto refuse = [](const Status& status, StatusCode code, const std::string& words) {
    CAPTURE(status.message);
    CHECK(status.code == code);
    CHECK(status.message.find(words) != std::string::npos);
  };
  {
    const Without without({"GL_EXT_float_blend"});
    refuse(without.fake.create().status, StatusCode::ContextTooOld, "without GL_EXT_float_blend");
  }
  {
    const Without without({"GL_EXT_disjoint_timer_query"});
    refuse(Effect::create({without.fake.loader(), PassTiming::TimerQuery}).status, StatusCode::InvalidConfig,
           "Config::timing is TimerQuery: this context has no GL_EXT_disjoint_timer_query");
  }
  const GlLoader loader = tests::testContext().loader();
  refuse(Avsm::create({loader}).status, StatusCode::ContextTooOld, "OpenGL 4.3 core or later is needed");
  {
    const FakeContext old({}, {{"glGetIntegerv", address(sayVersion31)}});
    refuse(old.create().status, StatusCode::ContextTooOld, "OpenGL 3.3 core, OpenGL ES 3.2 or later is needed");
  }
  {
    const FakeContext fake({"glMapBufferRange"});
    refuse(fake.create().status, StatusCode::ContextTooOld, "knows no glMapBufferRange");
  }
}

TEST_CASE("OpenGL ES: passes are timed", "[gles][once]") {
  const std::unique_ptr<Effect> effect = tests::newEffect({tests::testContext().loader(), PassTiming::TimerQuery});
  tests::Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  stage.draw(*effect);
  CHECK_FALSE(effect->statistics().passes.empty());
}

// All of them are read by the Khronos reference compiler (shaders.reference).
TEST_CASE("OpenGL ES: programs build, with any two definitions", "[gles][once][slow]") {
  tests::testContext();
  const std::vector<tests::ProgramText> texts = tests::embeddedPairs();
  CHECK(texts.size() >= 400);
  for (const tests::ProgramText& text : texts)
    try {
      const host::Program built(text.name, text.vertex.c_str(), text.fragment.c_str());
    } catch (const host::Error& error) {
      FAIL_CHECK(error.what());
    }
}
