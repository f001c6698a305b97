// A driver that fails to compile, to link, to render to a format or to find memory: a status, and nothing drawn. And
// one whose context is lost.
#include "FakeContext.h"
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <utility>

using namespace tyndall;
using tests::address;
using tests::FakeContext;

namespace {

int failFrom = 0; // the call from which on the function below fails

void GLAD_API_PTR refuseShaders(GLuint shader, GLenum name, GLint* value) {
  host::gl().GetShaderiv(shader, name, value);
  if (name == GL_COMPILE_STATUS) *value = GL_FALSE;
}
void GLAD_API_PTR refuseToLink(GLuint program, GLenum name, GLint* value) {
  host::gl().GetProgramiv(program, name, value);
  if (name == GL_LINK_STATUS && --failFrom <= 0) *value = GL_FALSE;
}
GLenum GLAD_API_PTR refuseFramebuffer(GLenum target) {
  return --failFrom <= 0 ? GL_FRAMEBUFFER_UNSUPPORTED : host::gl().CheckFramebufferStatus(target);
}

// Memory that has run out, and GL's one error flag: an error of the engine's, if it was there first, hides ours.
GLenum flag = GL_NO_ERROR;
void GLAD_API_PTR allocateNothing(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*) {
  if (flag == GL_NO_ERROR) flag = GL_OUT_OF_MEMORY;
}
GLenum GLAD_API_PTR askFlag() { return flag != GL_NO_ERROR ? std::exchange(flag, GL_NO_ERROR) : host::gl().GetError(); }
const std::map<std::string, void*> kNoMemory = {{"glTexImage2D", address(allocateNothing)},
                                                {"glGetError", address(askFlag)}};

// A reset of the GPU, as soon as there have been so many draws: GL answers questions about objects with no.
bool lost = false;
int drawsUntilLost = 0;
GLenum GLAD_API_PTR errorOfLostContext() { return lost ? GL_CONTEXT_LOST : host::gl().GetError(); }
GLboolean GLAD_API_PTR isArray(GLuint name) { return lost ? GL_FALSE : host::gl().IsVertexArray(name); }
GLenum GLAD_API_PTR resetOnce() { return std::exchange(lost, false) ? GL_INNOCENT_CONTEXT_RESET : GL_NO_ERROR; }
void GLAD_API_PTR drawUntilLost(GLenum mode, GLint first, GLsizei count) {
  if (--drawsUntilLost < 0) lost = true;
  if (!lost) host::gl().DrawArrays(mode, first, count);
}
const std::map<std::string, void*> kErrors = {{"glGetError", address(errorOfLostContext)},
                                              {"glIsVertexArray", address(isArray)},
                                              {"glDrawArrays", address(drawUntilLost)}};
const std::map<std::string, void*> kResetStatus = {{"glGetGraphicsResetStatus", address(resetOnce)},
                                                   {"glGetGraphicsResetStatusARB", address(resetOnce)},
                                                   {"glDrawArrays", address(drawUntilLost)}};

// The ways to learn of a loss that this context has.
std::vector<std::map<std::string, void*>> lossSigns() {
  if (tests::testContext().glVersion() < 45) return {kErrors};
  return {kErrors, kResetStatus};
}

void checkLost(const Status& status) {
  INFO(status.message);
  CHECK(status.code == StatusCode::ContextLost);
  CHECK(status.message.find("lost") != std::string::npos);
}

struct FailingFrame {
  tests::SceneRig scene;
  std::vector<float> content = std::vector<float>(4 * 24 * 16, 0.5F);
  host::GlTexture colour = scene.makeColour(GL_RGBA16F, content);
  host::GlTexture inscatter, transmittance;

  FailingFrame() {
    scene.addLight(LightKind::Directional);
    inscatter = tests::floatTexture(GL_RGBA32F, 24, 16, content);
    transmittance = tests::floatTexture(GL_RGBA32F, 24, 16, content);
    scene.frame.output = {inscatter.name(), transmittance.name()};
  }
  void check(Effect& effect, StatusCode code) {
    const Status status = effect.render(scene.frame);
    INFO(status.message);
    CHECK(status.code == code);
    CHECK_FALSE(status.message.empty());
    CHECK(status.message.find('\0') == std::string::npos);
    for (const host::GlTexture* target : {&colour, &inscatter, &transmittance})
      CHECK(tests::bitEqual(host::readColour(target->name(), 24, 16), content));
  }
};

} // namespace

TEST_CASE("a shader that does not compile is reported and nothing is drawn") {
  FailingFrame frame;
  const FakeContext fake({}, {{"glGetShaderiv", address(refuseShaders)}});
  const CreateResult result = fake.create();
  REQUIRE(result.effect);
  frame.check(*result.effect, StatusCode::ShaderError);
  CHECK(result.effect->compileAll().code == StatusCode::ShaderError);
}

TEST_CASE("a program that does not link is reported and nothing is drawn, whichever pass it is of") {
  FailingFrame frame;
  const FakeContext fake({}, {{"glGetProgramiv", address(refuseToLink)}});
  for (failFrom = 1; failFrom <= 2;) {
    const int call = failFrom;
    CAPTURE(call);
    const CreateResult result = fake.create();
    REQUIRE(result.effect);
    frame.check(*result.effect, StatusCode::ShaderError);
    failFrom = call + 1;
  }
}

TEST_CASE("a framebuffer that the context refuses is reported and nothing is drawn, whichever pass it is of") {
  FailingFrame frame;
  const FakeContext fake({}, {{"glCheckFramebufferStatus", address(refuseFramebuffer)}});
  for (failFrom = 1; failFrom <= 2;) {
    const int call = failFrom;
    CAPTURE(call);
    const CreateResult result = fake.create();
    REQUIRE(result.effect);
    frame.check(*result.effect, StatusCode::InvalidFrame);
    failFrom = call + 1;
  }
}

TEST_CASE("running out of memory is reported and nothing is drawn") {
  FailingFrame frame;
  frame.scene.frame.output.transmittance = 0; // so that a target of the effect's own is needed
  flag = GL_NO_ERROR;
  const FakeContext fake({}, kNoMemory);
  const CreateResult result = fake.create();
  REQUIRE(result.effect);
  frame.check(*result.effect, StatusCode::OutOfMemory);
  CHECK(result.effect->statistics().bytes < 16 * 24 * 16);
}

TEST_CASE("a lost context is never Ok, whether errors or the reset status say so, and stays lost") {
  for (const auto& signs : lossSigns()) {
    CAPTURE(signs.size());
    FailingFrame frame;
    const FakeContext fake({}, signs);
    drawsUntilLost = 1 << 30;
    lost = true;
    checkLost(fake.create().status);
    for (const bool compiles : {false, true}) {
      lost = false;
      const CreateResult result = fake.create();
      REQUIRE(result.effect);
      CHECK(result.effect->render(frame.scene.frame));
      lost = true;
      checkLost(compiles ? result.effect->compileAll() : result.effect->render(frame.scene.frame));
      lost = false; // GL may tell of it once only
      checkLost(result.effect->render(frame.scene.frame));
      checkLost(result.effect->compileAll());
    }
  }
}

TEST_CASE("a context that is lost in the middle of a frame is not Ok") {
  for (const auto& signs : lossSigns())
    for (const Technique technique : {Technique::Exact, Technique::Epipolar})
      for (int draws = 0; draws < 3; ++draws) {
        FailingFrame frame;
        frame.scene.frame.settings.technique = technique;
        frame.scene.frame.settings.debugView = DebugView::Difference; // many draws, and a mean that is read
        const FakeContext fake({}, signs);
        lost = false;
        const CreateResult result = fake.create();
        REQUIRE(result.effect);
        drawsUntilLost = draws;
        checkLost(result.effect->render(frame.scene.frame));
        CAPTURE(result.effect->statistics().passes.size()); // must return
      }
  lost = false;
}
