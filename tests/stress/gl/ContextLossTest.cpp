// A GPU that is reset at any call: the call that notices says so, all that come after it do, and none hangs or crashes.
#include "gl/effect/FaultyContext.h"
#include "gl/effect/FrameCases.h"
#include "support/Catch.h"
#include "support/TestContext.h"

using namespace tyndall;

namespace {

int callsOf(tests::FaultyContext& context, Effect& effect, const Frame& frame) {
  context.resetCounts();
  CHECK(effect.render(frame));
  return context.calls();
}

} // namespace

TEST_CASE("a context that is lost at any call of a frame is told of, and stays lost", "[once]") {
  if (tests::testContext().glVersion() < 45) {
    WARN("skipped: the context has no reset status");
    return;
  }
  tests::FaultyContext context;
  int lost = 0, late = 0;
  for (const char* name : {"epipolar, two lights, all targets", "exact", "detect, a part", "objects, mesh"}) {
    const tests::FrameCase& item = tests::frameCase(name);
    tests::Stage stage(item);
    for (const bool fresh : {true, false}) {
      int calls = 0;
      {
        const CreateResult counted = context.create();
        REQUIRE(counted.effect);
        if (!fresh) CHECK(counted.effect->render(stage.frame()));
        calls = callsOf(context, *counted.effect, stage.frame());
      }
      for (int call = 1; call <= calls; call += fresh ? 61 : 5) {
        CAPTURE(name, fresh, call);
        CreateResult created = context.create();
        REQUIRE(created.effect);
        if (!fresh) CHECK(created.effect->render(stage.frame()));
        context.loseAt(call);
        const Status status = created.effect->render(stage.frame());
        if (!context.isLost()) { // what is known of programs by now saves some calls
          context.recover();
          break;
        }
        if (status.code == StatusCode::ContextLost) ++lost;
        if (status) ++late; // by the last calls, after it was asked for
        CHECK((status || status.code == StatusCode::ContextLost));
        CHECK(created.effect->render(stage.frame()).code == StatusCode::ContextLost);
        CHECK(created.effect->compileAll().code == StatusCode::ContextLost);
        created.effect->statistics();
        created.effect.reset();
        context.recover();
        tests::testContext().takeErrors();
      }
    }
  }
  CHECK(lost > 100);
  CHECK(late < lost / 20);
}

TEST_CASE("create in a context that is lost at any of its calls is refused or makes an effect that says so", "[once]") {
  if (tests::testContext().glVersion() < 45) {
    WARN("skipped: the context has no reset status");
    return;
  }
  tests::FaultyContext context;
  context.resetCounts();
  REQUIRE(context.create().effect);
  const int calls = context.calls();
  tests::Stage stage(tests::frameCase("exact"));
  for (int call = 1; call <= calls; ++call) {
    CAPTURE(call);
    context.loseAt(call);
    const CreateResult created = context.create();
    if (created.effect)
      CHECK(created.effect->render(stage.frame()).code == StatusCode::ContextLost);
    else
      CHECK(created.status.code != StatusCode::Ok);
    context.recover();
    tests::testContext().takeErrors();
  }
}
