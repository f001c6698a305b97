// An error of the engine's own that it has not asked for yet: it stays, hides no failure of ours, and no failure of
// ours is left in its place.
#include "../avsm/AvsmRig.h"
#include "FaultSweep.h"
#include "support/Catch.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;
using tests::Fault;
using tests::FaultyContext;
using tests::newEffect;
using tests::Stage;
using tests::Times;

namespace {

struct EngineError {
  GLenum code;
  std::function<void()> make;
};

const std::vector<EngineError>& engineErrors() {
  static const std::vector<EngineError> all = {
      {GL_INVALID_ENUM, [] { gl().Enable(0xDEAD); }},
      {GL_INVALID_VALUE, [] { gl().Viewport(0, 0, -1, -1); }},
      {GL_INVALID_OPERATION, [] { gl().EndQuery(GL_SAMPLES_PASSED); }},
      {GL_INVALID_FRAMEBUFFER_OPERATION,
       [] {
         const host::GlFramebuffer incomplete = host::makeFramebuffer();
         gl().BindFramebuffer(GL_FRAMEBUFFER, incomplete.name());
         gl().Clear(GL_COLOR_BUFFER_BIT);
         gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
       }},
      {GL_OUT_OF_MEMORY, [] { tests::setGlError(GL_OUT_OF_MEMORY); }},
  };
  return all;
}

// With the debug output, where there is one, off, so that no message of the engine's own is among those that are
// checked.
void makePending(const EngineError& error) {
  const bool hasOutput = gl().DebugMessageCallback != nullptr; // as the host asks
  if (hasOutput) gl().Disable(GL_DEBUG_OUTPUT);
  error.make();
  if (hasOutput) gl().Enable(GL_DEBUG_OUTPUT);
}

// Runs a call with each error pending; afterwards that and no other must be, and no message.
void checkStays(const std::string& name, const std::function<void()>& call) {
  for (const EngineError& error : engineErrors()) {
    CAPTURE(name, error.code);
    tests::testContext().takeErrors();
    makePending(error);
    call();
    CHECK(tests::takeGlError() == error.code);
    CHECK(tests::takeGlError() == GL_NO_ERROR);
    if (gl().DebugMessageCallback) CHECK(gl().IsEnabled(GL_DEBUG_OUTPUT));
    for (const std::string& message : tests::testContext().takeErrors())
      FAIL_CHECK(message);
  }
}

void require(const Status& status) {
  INFO(status.message);
  REQUIRE(status);
}

} // namespace

TEST_CASE("an engine's pending error stays: create, statistics, and the end of an effect") {
  const FaultyContext context;
  std::unique_ptr<Effect> effect;
  checkStays("create", [&] { effect = newEffect({context.loader()}); });
  checkStays("create, refused", [&] { CHECK_FALSE(Effect::create({}).effect); });
  Stage stage(tests::frameCase("epipolar"));
  effect = newEffect({context.loader(), PassTiming::TimerQuery});
  stage.draw(*effect);
  checkStays("statistics", [&] { effect->statistics(); });
  checkStays("end", [&] {
    effect.reset();
    effect = newEffect({context.loader()});
  });
}

TEST_CASE("an engine's pending error stays: frames of every kind, and their pictures are right") {
  FaultyContext context;
  for (const tests::FrameCase& item : tests::frameCases()) {
    if (!tests::canDraw(item)) continue;
    context.setMaxTextureSize(item.maxTextureSize);
    Stage stage(item);
    const std::unique_ptr<Effect> effect = newEffect(tests::configFor(item, context.loader()));
    const tests::TargetContents expected = stage.draw(*effect);
    checkStays(item.name, [&] {
      const std::unique_ptr<Effect> fresh = newEffect(tests::configFor(item, context.loader()));
      stage.fill();
      require(fresh->render(stage.frame()));
      CHECK(tests::bitEqual(stage.read(), expected));
    });
  }
}

TEST_CASE("an engine's pending error stays: prepare, compileAll, and frames that are refused") {
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar, two lights"));
  std::unique_ptr<Effect> effect = newEffect({context.loader()});
  checkStays("prepare", [&] { require(effect->prepare(stage.frame()).status); });
  checkStays("compileAll, with shaders that do not build", [&] {
    context.fail(Fault::Compile, 1, Times::From);
    CHECK(newEffect({context.loader()})->compileAll().code == StatusCode::ShaderError);
    context.heal();
  });
  Frame broken = stage.frame();
  broken.depth.texture = broken.colour;
  checkStays("render, refused", [&] { CHECK(effect->render(broken).code == StatusCode::InvalidFrame); });
  checkStays("prepare, refused", [&] { CHECK(effect->prepare(broken).status.code == StatusCode::InvalidFrame); });
}

TEST_CASE("an engine's pending error hides no allocation that fails", "[once]") {
  FaultyContext context;
  for (const char* name :
       {"epipolar", "epipolar, two lights", "tree, two lights, all targets", "exact, lamp, all targets", "low rank",
        "view 9", "detect, first frame", "detect, a part", "objects, a part",
        "detect, two lights, by the stencil, fix-up by tiles", "epipolar, colour copied"}) {
    const tests::FrameCase& item = tests::frameCase(name);
    tests::FaultSweep sweep(context, item);
    for (const Fault kind : {Fault::Texture, Fault::Renderbuffer, Fault::Buffer, Fault::Framebuffer})
      for (const Times times : {Times::From, Times::Only})
        for (const GLenum pending : {GL_INVALID_ENUM, GL_OUT_OF_MEMORY}) {
          const tests::SweepOptions options{kind, times, false, pending};
          const tests::Findings findings = sweep.run(options);
          if (!findings.empty())
            FAIL_CHECK(name << ": " << nameOf(options) << ", pending " << pending << findings.text());
        }
  }
}

TEST_CASE("an engine's pending error stays: an AVSM") {
  if (!tests::hasAvsm()) return;
  const FaultyContext context;
  AvsmConfig config = tests::configOf(CurveReduction::WholeCurve, 16, 4);
  config.loader = context.loader();
  const host::GlBuffer buffer = host::makeBuffer();
  const std::vector<float> sphere = {0, 0, 0, 0.5F, 1};
  gl().BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(sphere.size() * sizeof(float)), sphere.data(),
                  GL_STATIC_DRAW);
  AvsmParticles particles;
  particles.buffer = buffer.name();
  particles.count = 1;
  Light light;
  light.direction = {0, 0, -1};
  light.shadow.views = {{tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1))), 0}};

  AvsmResult made;
  checkStays("create", [&] {
    made = Avsm::create(config);
    require(made.status);
  });
  Avsm& avsm = *made.avsm;
  checkStays("begin", [&] { require(avsm.begin()); });
  checkStays("begin and resolve", [&] {
    require(avsm.begin());
    require(avsm.resolve());
  });
  checkStays("capture and resolve", [&] {
    tests::captureInto(avsm, {{{4, 4, 0}, 0.2F, 0.5F, 0.5F}});
    require(avsm.resolve());
  });
  checkStays("statistics", [&] { avsm.statistics(); });
  checkStays("streaming", [&] {
    require(avsm.beginStreaming());
    require(avsm.drawParticles(light, particles));
    require(avsm.bindCurves(0));
    require(avsm.resolve());
  });
  checkStays("refused", [&] {
    CHECK_FALSE(avsm.begin(1U << 30));
    CHECK_FALSE(avsm.drawParticles(light, particles));
    CHECK_FALSE(avsm.bindCurves(0));
  });
  checkStays("end", [&] {
    made.avsm.reset();
    made = Avsm::create(config);
  });
}
