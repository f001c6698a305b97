// Config::betweenDraws: what a tool does meanwhile changes nothing, and a frame that is given up leaves no trace.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "GlState.h"
#include "support/Catch.h"

#include <chrono>
#include <gl/Context.h>
#include <support/TestContext.h>
#include <thread>

using namespace tyndall;
using tests::Call;
using tests::FaultyContext;
using tests::Stage;

namespace {

constexpr double kSquares = 1.5e-4; ///< milliseconds of a band: a few pixels
constexpr std::array<const char*, 5> kCases = {"epipolar, two lights, all targets", "epipolar, spread",
                                               "tree, two lights, all targets", "exact, lamp, all targets",
                                               "objects, a part"};

int countOf(Call call) { return tests::callRows().at(static_cast<std::size_t>(call)).count; }
int draws() { return countOf(Call::DrawArrays) + countOf(Call::DrawArraysInstanced); }

std::unique_ptr<Effect> effectOf(const FaultyContext& context, std::function<bool()> betweenDraws,
                                 PassTiming timing = PassTiming::Off) {
  Config config;
  config.loader = context.loader();
  config.timing = timing;
  config.tuning.bandMilliseconds = kSquares;
  config.betweenDraws = std::move(betweenDraws);
  return tests::newEffect(config);
}

/// Of the view's first frames, where each may differ from the one before in what is drawn.
constexpr int kFrames = 3;

/// Draws of each frame.
std::vector<int> countDraws(const FaultyContext& context, const tests::FrameCase& item) {
  const std::unique_ptr<Effect> effect = effectOf(context, [] { return true; });
  Stage stage(item);
  std::vector<int> counts;
  for (int i = 0; i < kFrames; ++i) {
    const int before = draws();
    stage.draw(*effect);
    counts.push_back(draws() - before);
    stage.advance();
  }
  return counts;
}

} // namespace

TEST_CASE("between draws: it is asked between any two of them, and the picture is that of a frame without it") {
  FaultyContext context;
  for (const char* name : kCases) {
    CAPTURE(name);
    const tests::FrameCase& item = tests::frameCase(name);
    int asked = 0;
    const std::unique_ptr<Effect> plain = effectOf(context, {}),
                                  watched = effectOf(context, [&] { return ++asked > 0; });
    Stage expected(item), got(item);
    for (int i = 0; i < kFrames; ++i) {
      const tests::TargetContents picture = expected.draw(*plain);
      const int before = draws();
      asked = 0;
      CHECK(tests::same(got.draw(*watched), picture));
      CHECK(asked == draws() - before - 1);
      CHECK(asked > 3);
      expected.advance();
      got.advance();
    }
  }
}

TEST_CASE("between draws: what is drawn in another context meanwhile does not matter") {
  host::Context& own = tests::testContext();
  const std::unique_ptr<host::Context> other =
      host::Context::create(tests::testContextKind(), tests::testContextOptions());
  own.makeCurrent();
  int turns = 0;
  const auto drawElsewhere = [&] {
    other->makeCurrent();
    {
      const host::GlTexture texture = host::makeTexture2D(GL_RGBA8, 4, 4);
      const host::GlFramebuffer framebuffer = host::makeFramebuffer();
      const GladGLContext& gl = host::gl();
      gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
      gl.Enable(GL_SCISSOR_TEST);
      gl.Scissor(1, 1, 2, 2);
      gl.ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
      gl.Clear(GL_COLOR_BUFFER_BIT);
      gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    own.makeCurrent();
    return ++turns > 0;
  };
  Config config;
  config.loader = own.loader();
  const std::unique_ptr<Effect> plain = tests::newEffect(config);
  config.betweenDraws = drawElsewhere;
  const std::unique_ptr<Effect> watched = tests::newEffect(config);
  Stage expected(tests::frameCase("epipolar, two lights, all targets")),
      got(tests::frameCase("epipolar, two lights, all targets"));
  CHECK(tests::same(got.draw(*watched), expected.draw(*plain)));
  CHECK(turns > 5);
}

TEST_CASE("between draws: a frame that is given up at any of them draws no more, and the next frames are as ever") {
  FaultyContext context;
  for (const char* name : kCases) {
    CAPTURE(name);
    const tests::FrameCase& item = tests::frameCase(name);
    const std::vector<int> counts = countDraws(context, item);
    for (int last = 1; last < counts.back(); last += 1 + counts.back() / 4) { // the last draw that is drawn
      CAPTURE(last);
      int left = -1;
      const std::unique_ptr<Effect> plain = effectOf(context, {}),
                                    effect = effectOf(context, [&] { return --left != 0; });
      Stage expected(item), got(item);
      for (int i = 0; i < kFrames - 1; ++i) {
        expected.draw(*plain);
        got.draw(*effect);
        expected.advance();
        got.advance();
      }
      const int before = draws();
      left = last;
      const Status status = effect->render(got.frame());
      CHECK(status.code == StatusCode::Abandoned);
      CHECK(status.message.find("Config::betweenDraws") != std::string::npos);
      CHECK(draws() - before == last);
      static_cast<void>(effect->statistics());
      // Nothing of it is taken for a picture of before.
      for (int i = 0; i < 2; ++i) {
        left = -1;
        CHECK(tests::same(got.draw(*effect), expected.draw(*plain)));
        expected.rest();
        got.rest();
      }
    }
  }
}

TEST_CASE("between draws: GL's state is given back by a frame that is given up") {
  FaultyContext context;
  const std::unique_ptr<Effect> effect = effectOf(context, [] { return false; });
  Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  static_cast<void>(effect->render(stage.frame()));
  const tests::Poison poison;
  const tests::GlState before = tests::captureGlState();
  CHECK(effect->render(stage.frame()).code == StatusCode::Abandoned);
  CHECK(tests::same(tests::captureGlState(), before));
  tests::Poison::lift();
}

TEST_CASE("between draws: passes that are timed by the wall clock do not count what is done meanwhile") {
  using Clock = std::chrono::steady_clock;
  constexpr auto kNap = std::chrono::milliseconds(5);
  FaultyContext context;
  int asked = 0;
  const std::unique_ptr<Effect> effect = effectOf(
      context,
      [&] {
        std::this_thread::sleep_for(kNap);
        return ++asked > 0;
      },
      PassTiming::Finish);
  Stage stage(tests::frameCase("exact"), 16, 8);
  stage.draw(*effect);
  asked = 0;
  const auto start = Clock::now();
  stage.draw(*effect);
  const double all = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  double passes = 0;
  for (const PassStatistics& pass : effect->statistics().passes)
    passes += pass.milliseconds;
  REQUIRE(asked > 3);
  CHECK(passes <= all - 5 * asked);
}
