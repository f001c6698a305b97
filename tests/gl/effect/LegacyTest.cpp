// What only a context of the compatibility profile can have under way when it calls: each is refused by name, and
// afterwards the effect draws as before. What such a context may leave behind: LegacyState.cpp.
#include "LegacyGl.h"
#include "SceneRig.h"
#include "gl/RenderTargets.h"
#include "support/Catch.h"

#include <functional>
#include <tyndall/avsm.h>

using namespace tyndall;
using host::gl;
using tests::legacy::call;

namespace {

struct LegacyRig {
  tests::SceneRig scene;
  std::unique_ptr<Effect> effect = tests::newEffect();

  LegacyRig() { scene.addLight(LightKind::Spot, tests::Casters::Blocks, true); }
};

void checkRefused(LegacyRig& rig, StatusCode code, const std::string& words) {
  const Frame& frame = rig.scene.frame;
  for (const Status& status :
       {rig.effect->render(frame), rig.effect->prepare(frame).status, rig.effect->compileAll()}) {
    CAPTURE(status.message);
    CHECK(status.code == code);
    CHECK(status.message.find(words) != std::string::npos);
    CHECK(status.message.find('\n') == std::string::npos);
  }
}

void checkCreateRefused(StatusCode code, const std::string& words) {
  const auto loader = tests::testContext().loader();
  for (const Status& status : {Effect::create({loader}).status, Avsm::create({loader}).status}) {
    CAPTURE(status.message);
    CHECK(status.code == code);
    CHECK(status.message.find(words) != std::string::npos);
  }
}

} // namespace

TEST_CASE("display lists being compiled are refused by name, and hold nothing of the effect", "[compatibility][once]") {
  LegacyRig rig;
  const reference::ImageAnswer expected = rig.scene.render(*rig.effect);
  for (const GLenum mode : {tests::legacy::COMPILE, tests::legacy::COMPILE_AND_EXECUTE}) {
    CAPTURE(mode);
    call<void, GLuint, GLenum>("glNewList", 7, mode);
    checkRefused(rig, StatusCode::InvalidFrame, "display list 7 is being compiled: call glEndList before Effect::");
    checkCreateRefused(StatusCode::InvalidFrame, "display list 7 is being compiled: call glEndList before ");
    call<void>("glEndList");
    gl().UseProgram(0);
    call<void, GLuint>("glCallList", 7);
    CHECK(tests::testContext().takeErrors().empty());
    CHECK(rig.scene.render(*rig.effect).inscatter == expected.inscatter);
  }
}

TEST_CASE("calls between glBegin and glEnd are refused", "[compatibility][once]") {
  LegacyRig rig;
  const reference::ImageAnswer expected = rig.scene.render(*rig.effect);
  const host::RenderTargets targets({4, 4, GL_RGBA32F});
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  call<void, GLenum>("glBegin", GL_TRIANGLES);
  checkRefused(rig, StatusCode::NoContext, "or glBegin was called in it without glEnd");
  checkCreateRefused(StatusCode::NoContext, "or glBegin was called in it without glEnd");
  call<void>("glEnd");
  tests::testContext().takeErrors(); // of questions that GL does not take there
  CHECK(rig.scene.render(*rig.effect).inscatter == expected.inscatter);
  CHECK(tests::testContext().takeErrors().empty());
}

TEST_CASE("depth that is given as luminance or intensity is read, as alpha refused", "[compatibility][once]") {
  LegacyRig rig;
  const reference::ImageAnswer expected = rig.scene.render(*rig.effect);
  const auto give = [&](GLint mode) {
    gl().BindTexture(GL_TEXTURE_2D, rig.scene.frame.depth.texture);
    gl().TexParameteri(GL_TEXTURE_2D, tests::legacy::DEPTH_TEXTURE_MODE, mode);
  };
  for (const GLint mode : {0x1909 /* GL_LUMINANCE */, 0x8049 /* GL_INTENSITY */, GL_RED}) {
    CAPTURE(mode);
    give(mode);
    CHECK(rig.scene.render(*rig.effect).inscatter == expected.inscatter);
  }
  give(GL_ALPHA);
  const Status status = rig.effect->render(rig.scene.frame);
  CHECK(status.code == StatusCode::InvalidFrame);
  CHECK(status.message.find("Frame::depth.texture") == 0);
  CHECK(status.message.find("GL_DEPTH_TEXTURE_MODE must not be GL_ALPHA") != std::string::npos);
}

TEST_CASE("the compatibility profile draws the picture of the core profile", "[compatibility][once]") {
  reference::ImageAnswer answers[2];
  for (const auto profile : {host::ContextProfile::Core, host::ContextProfile::Compatibility}) {
    const auto context = host::Context::create(tests::testContextKind(), {/*debug*/ true, profile});
    GLint is = 0;
    gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &is);
    CHECK(is ==
          (profile == host::ContextProfile::Core ? GL_CONTEXT_CORE_PROFILE_BIT : GL_CONTEXT_COMPATIBILITY_PROFILE_BIT));
    {
      tests::SceneRig scene(24, 16, tests::RigContext::Current);
      for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
        scene.addLight(kind, tests::Casters::Blocks, kind == LightKind::Spot);
      answers[static_cast<int>(profile)] = scene.render(*tests::newEffect({context->loader()}));
    }
    CHECK(context->takeErrors().empty());
  }
  CHECK(answers[0].inscatter == answers[1].inscatter);
  CHECK(answers[0].transmittance == answers[1].transmittance);
}
