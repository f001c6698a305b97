// GL errors that the engine has made and not asked for: none hides a failure of ours, none is taken from the engine or
// told to its debug callback again.
#include "FakeContext.h"
#include "LegacyState.h"
#include "ReuseRig.h"
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <limits>
#include <utility>

using namespace tyndall;
using host::gl;
using tests::address;
using tests::FakeContext;

namespace {

// How an engine makes an error of each kind; without what it needs for that, none.
void makeError(GLenum error) {
  const bool groups = tests::testContext().glVersion() >= 43;
  switch (error) {
  case GL_INVALID_ENUM:
    return gl().Enable(GL_TEXTURE_2D_ARRAY);
  case GL_INVALID_VALUE:
    return gl().Viewport(0, 0, -1, -1);
  case GL_INVALID_OPERATION:
    return gl().UseProgram(gl().CreateShader(GL_VERTEX_SHADER));
  case GL_INVALID_FRAMEBUFFER_OPERATION: {
    const host::GlFramebuffer empty = host::makeFramebuffer();
    gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, empty.name());
    gl().Clear(GL_COLOR_BUFFER_BIT);
    return gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  }
  case GL_OUT_OF_MEMORY: {
    const host::GlBuffer buffer = host::makeBuffer();
    gl().BindBuffer(GL_ARRAY_BUFFER, buffer.name());
    gl().BufferData(GL_ARRAY_BUFFER, std::numeric_limits<GLsizeiptr>::max(), nullptr, GL_STATIC_DRAW);
    return gl().BindBuffer(GL_ARRAY_BUFFER, 0);
  }
  case GL_STACK_OVERFLOW:
    for (int i = 0; i < 64 && groups; ++i)
      gl().PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "engine");
    for (int i = 0; i < 63 && groups; ++i)
      gl().PopDebugGroup();
    return;
  case GL_STACK_UNDERFLOW:
    if (groups) gl().PopDebugGroup();
    return;
  default:
    return;
  }
}

constexpr GLenum kKinds[] = {GL_NO_ERROR,          GL_INVALID_ENUM,   GL_INVALID_VALUE,
                             GL_INVALID_OPERATION, GL_OUT_OF_MEMORY,  GL_INVALID_FRAMEBUFFER_OPERATION,
                             GL_STACK_OVERFLOW,    GL_STACK_UNDERFLOW};

// What GL says after a call that began with an error pending: that error, and nothing else.
void checkPending(GLenum error) {
  CHECK(gl().GetError() == error);
  CHECK(gl().GetError() == GL_NO_ERROR);
}

// Makes an error, and takes the message that the engine's callback gets; none if it cannot be made here.
GLenum leavePending(GLenum error) {
  makeError(error);
  const GLenum made = gl().GetError();
  makeError(error);
  CHECK((made == error || made == GL_NO_ERROR));
  return made;
}

int asked = 0;
GLenum GLAD_API_PTR countQuestions() {
  ++asked;
  return gl().GetError();
}

// Memory that has run out behind GL's one error flag.
GLenum flag = GL_NO_ERROR;
void GLAD_API_PTR allocateNothing(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*) {
  if (flag == GL_NO_ERROR) flag = GL_OUT_OF_MEMORY;
}
void GLAD_API_PTR storeNothing(GLenum, GLenum, GLsizei, GLsizei) {
  if (flag == GL_NO_ERROR) flag = GL_OUT_OF_MEMORY;
}
GLenum GLAD_API_PTR askFlag() { return flag != GL_NO_ERROR ? std::exchange(flag, GL_NO_ERROR) : gl().GetError(); }

} // namespace

TEST_CASE("pending errors: the engine finds its own after any call, and its callback hears of none twice") {
  tests::ShaftRig rig = tests::smallShaftRig(Technique::Epipolar);
  Frame wrong = rig.scene.frame;
  wrong.lights[0].shadow.array = !wrong.lights[0].shadow.array;
  // Mesa tells targets in the core profile only.
  for (const bool asksTargets : {!tests::isCompatibility(), false})
    for (const GLenum error : kKinds) {
      CAPTURE(asksTargets, error);
      const FakeContext fake(asksTargets ? std::set<std::string>{} : std::set<std::string>{"glGetTextureParameteriv"});
      const GLenum pending = leavePending(error);
      const CreateResult created = fake.create();
      REQUIRE(created.effect);
      Effect& effect = *created.effect;
      checkPending(pending);
      leavePending(error);
      CHECK(effect.render(rig.scene.frame)); // makes textures
      checkPending(pending);
      leavePending(error);
      CHECK(effect.render(rig.scene.frame));
      checkPending(pending);
      leavePending(error);
      const Status status = effect.render(wrong);
      CHECK(status.message.find("must be a GL_TEXTURE_2D") != std::string::npos);
      checkPending(pending);
      // What the callback heard is what the test made: three or four times two, and the binding to a wrong target.
      const std::size_t heard = tests::testContext().takeErrors().size();
      CHECK(heard <= 8 + (asksTargets ? 0 : 1));
      if (pending == GL_NO_ERROR && asksTargets) CHECK(heard == 0);
    }
}

TEST_CASE("pending errors: a frame of which all is there asks for none") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
    for (const Changes changes : {Changes::Unknown, Changes::Detect}) {
      CAPTURE(static_cast<int>(technique), static_cast<int>(changes));
      tests::ShaftRig rig = tests::smallShaftRig(technique);
      rig.scene.frame.reuse.changes = changes;
      const FakeContext fake({}, {{"glGetError", address(countQuestions)}});
      const CreateResult created = fake.create();
      REQUIRE(created.effect);
      for (int frame = 0; frame < 3; ++frame)
        CHECK(created.effect->render(rig.scene.frame));
      CHECK((asked > 0 || technique == Technique::Exact)); // around what is made
      asked = 0;
      CHECK(created.effect->render(rig.scene.frame));
      CHECK((asked == 0 || tests::isCompatibility())); // there for targets of textures, by Mesa
    }
}

TEST_CASE("pending errors: memory that has run out is seen behind the engine's error") {
  for (const bool renderbuffers : {false, true})
    for (const GLenum engines : {GL_NO_ERROR, GL_INVALID_OPERATION, GL_OUT_OF_MEMORY}) {
      CAPTURE(renderbuffers, engines);
      tests::ShaftRig rig = tests::smallShaftRig(Technique::Epipolar);
      rig.scene.frame.output.transmittance = 0; // so that a target of the effect's own is needed
      std::map<std::string, void*> replaced = {{"glGetError", address(askFlag)}};
      if (renderbuffers)
        replaced["glRenderbufferStorage"] = address(storeNothing);
      else
        replaced["glTexImage2D"] = address(allocateNothing);
      const FakeContext fake({}, replaced);
      const CreateResult created = fake.create();
      REQUIRE(created.effect);
      for (int frame = 0; frame < 2; ++frame) {
        flag = engines;
        const Status status = created.effect->render(rig.scene.frame);
        CAPTURE(frame, status.message);
        CHECK(status.code == StatusCode::OutOfMemory);
        CHECK(askFlag() == engines);
        CHECK(askFlag() == GL_NO_ERROR);
      }
    }
  tests::testContext().takeErrors();
}
