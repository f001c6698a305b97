#include "gl/Gl.h"
#include "gl/ReadBack.h"
#include "gl/RenderTargets.h"
#include "scene/Error.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <cstdlib>

using host::Context;
using host::ContextKind;
using host::gl;

namespace {

/// A hidden window still needs a screen, and newer Mesas have no OSMesa.
bool isAvailable(ContextKind kind) {
  if (kind == ContextKind::Osmesa && !host::isOsmesaInstalled()) {
    WARN("skipped: an osmesa context needs libOSMesa, which is not installed");
    return false;
  }
  if (kind == ContextKind::Glfw && !std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) {
    WARN("skipped: a glfw context needs a display; run under xvfb-run to have one");
    return false;
  }
  return true;
}

/// Clears a small picture to a grey and reads it back: the context's own functions, all the way.
float clearedTo(float grey) {
  const host::RenderTargets targets({4, 4, GL_RGBA32F});
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().ClearColor(grey, grey, grey, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT);
  return host::readColour(targets.colour(), 4, 4, 1).front();
}

} // namespace

TEST_CASE("each kind of context gives a core profile that draws", "[context]") {
  for (const ContextKind kind : {ContextKind::Osmesa, ContextKind::Egl, ContextKind::Glfw}) {
    if (!isAvailable(kind)) {
      continue;
    }
    INFO(host::nameOf(kind));
    const auto context = Context::create(kind);
    CHECK(context->kind() == kind);
    CHECK(context->glVersion() >= 33);
    CHECK(context->driver().find("OpenGL") != std::string::npos);
    CHECK(context->loader()("glClear") != nullptr);
    GLint profile = 0;
    gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    CHECK(profile == GL_CONTEXT_CORE_PROFILE_BIT);
    CHECK(clearedTo(0.25F) == 0.25F);
    CHECK(context->takeErrors().empty());
  }
}

TEST_CASE("a context reports GL errors once", "[context]") {
  for (const bool debug : {true, false}) {
    const auto context = Context::create(tests::testContextKind(), {debug});
    gl().Enable(GL_TEXTURE_BORDER_COLOR);
    const std::vector<std::string> errors = context->takeErrors();
    REQUIRE(!errors.empty());
    CHECK(errors.back() == "GL_INVALID_ENUM");
    CHECK(errors.size() == (debug && gl().DebugMessageCallback ? 2 : 1));
    CHECK(context->takeErrors().empty());
  }
}

TEST_CASE("two contexts of one kind have objects of their own", "[context]") {
  const auto first = Context::create(tests::testContextKind());
  GLuint texture = 0;
  gl().GenTextures(1, &texture);
  gl().BindTexture(GL_TEXTURE_2D, texture);
  {
    const auto second = Context::create(tests::testContextKind());
    CHECK(!gl().IsTexture(texture));
    CHECK(clearedTo(0.5F) == 0.5F);
    first->makeCurrent();
    CHECK(gl().IsTexture(texture));
    second->makeCurrent();
    CHECK(clearedTo(0.75F) == 0.75F);
  }
  CHECK_THROWS_AS(gl(), host::Error);
  first->makeCurrent();
  CHECK(gl().IsTexture(texture));
  gl().DeleteTextures(1, &texture);
  CHECK(clearedTo(0.125F) == 0.125F);
  CHECK(first->takeErrors().empty());
}

TEST_CASE("contexts of different kinds take turns", "[context]") {
  std::vector<std::unique_ptr<Context>> contexts;
  for (const ContextKind kind : {ContextKind::Osmesa, ContextKind::Egl, ContextKind::Glfw}) {
    if (isAvailable(kind)) {
      contexts.push_back(Context::create(kind));
    }
  }
  if (contexts.size() < 2) {
    WARN("skipped: only one kind of context is installed");
    return;
  }
  for (int turn = 0; turn < 2; ++turn) {
    for (const auto& context : contexts) {
      context->makeCurrent();
      GLint profile = 0;
      gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
      CHECK(profile == GL_CONTEXT_CORE_PROFILE_BIT);
      CHECK(clearedTo(0.5F) == 0.5F);
      CHECK(context->takeErrors().empty());
    }
  }
}

TEST_CASE("takeErrors leaves the current context current", "[context]") {
  const auto first = Context::create(tests::testContextKind());
  const auto second = Context::create(tests::testContextKind());
  gl().Enable(GL_TEXTURE_BORDER_COLOR);
  CHECK(first->takeErrors().empty());
  CHECK(&gl() == &second->functions());
  CHECK(!second->takeErrors().empty());
  second->releaseCurrent();
  CHECK(second->takeErrors().empty());
  CHECK_THROWS_AS(gl(), host::Error);
}

TEST_CASE("context kinds have names", "[context]") {
  CHECK(host::parseContextKind("osmesa") == ContextKind::Osmesa);
  CHECK(host::parseContextKind("egl") == ContextKind::Egl);
  CHECK(host::parseContextKind("glfw") == ContextKind::Glfw);
  CHECK_THROWS_WITH(host::parseContextKind("glx"), "context 'glx': must be osmesa, egl or glfw");
  CHECK_THROWS_AS(host::parseContextKind(""), host::Error);
}
