// Draws in bands (Tuning::bandMilliseconds): the picture of whole draws, bit for bit, and no call more than bands take.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "support/Catch.h"

#include <algorithm>
#include <tuple>

using namespace tyndall;
using tests::Call;
using tests::FaultyContext;
using tests::FrameCase;
using tests::Stage;

namespace {

std::unique_ptr<Effect> effectOf(const FaultyContext& context, double bandMilliseconds,
                                 PassTiming timing = PassTiming::Off, Tuning tuning = {}) {
  tuning.bandMilliseconds = bandMilliseconds;
  return tests::newEffect({context.loader(), timing, {}, StateMode::Restore, tuning});
}

int countOf(Call call) { return tests::callRows().at(static_cast<std::size_t>(call)).count; }
int draws() { return countOf(Call::DrawArrays) + countOf(Call::DrawArraysInstanced); }

int mostBands(const Statistics& statistics) {
  int most = 0;
  for (const PassStatistics& pass : statistics.passes)
    most = std::max(most, pass.bands);
  return most;
}

int allBands(const Statistics& statistics) {
  int all = 0;
  for (const PassStatistics& pass : statistics.passes)
    all += pass.bands;
  return all;
}

// Both pictures of a view's first frames, and what they count. Returns the most bands of a pass.
int checkSame(FaultyContext& context, const FrameCase& item, int width, int height, double bandMilliseconds) {
  CAPTURE(item.name, width, height, bandMilliseconds);
  context.setMaxTextureSize(item.maxTextureSize);
  const std::unique_ptr<Effect> whole = effectOf(context, 0, PassTiming::Off, item.tuning),
                                banded = effectOf(context, bandMilliseconds, PassTiming::Off, item.tuning);
  Stage expected(item, width, height), got(item, width, height);
  int most = 0;
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(tests::same(got.draw(*banded), expected.draw(*whole)));
    const Statistics a = banded->statistics(), b = whole->statistics();
    most = std::max(most, mostBands(a));
    CHECK(mostBands(b) == 1);
    CHECK(a.fixupPixels == b.fixupPixels);
    CHECK(a.marchedSamples == b.marchedSamples);
    CHECK(a.redrawnShare == b.redrawnShare);
    expected.advance();
    got.advance();
  }
  return most;
}

// Of a frame of 32 x 24 pixels: squares of a few pixels, and some of a row where rays are followed.
constexpr double kSquares = 1.5e-4;

} // namespace

TEST_CASE("draws in bands give the picture of whole draws, bit for bit", "[once]") {
  FaultyContext context;
  for (const FrameCase& item : tests::frameCases())
    if (tests::canDraw(item)) CHECK(checkSame(context, item, 32, 24, kSquares) > 10);
}

TEST_CASE("draws in bands of rows, of pixels, and of odd and tiny images give the picture of whole draws", "[sweep]") {
  constexpr double kPixels = 1e-300; // each by itself
  FaultyContext context;
  for (const char* name :
       {"epipolar, two lights, all targets", "epipolar, spread", "tree, two lights, all targets",
        "exact, lamp, all targets", "low rank, glass", "detect, a part", "exact, multisampled depth"})
    for (const auto& [width, height, milliseconds] :
         {std::tuple(1, 1, kPixels), std::tuple(1, 17, kPixels), std::tuple(31, 1, kPixels), std::tuple(19, 7, 1e-3)})
      checkSame(context, tests::frameCase(name), width, height, milliseconds);
}

TEST_CASE("draws in bands give the picture of whole draws after they have learned how long they take") {
  FaultyContext context;
  for (const char* name : {"epipolar, two lights, all targets", "tree", "exact"}) {
    CAPTURE(name);
    const std::unique_ptr<Effect> whole = effectOf(context, 0), banded = effectOf(context, kSquares);
    Stage stage(tests::frameCase(name), 24, 16);
    const tests::TargetContents expected = stage.draw(*whole);
    int first = 0, last = 0;
    for (int i = 0; i < 8; ++i) {
      CHECK(tests::same(stage.draw(*banded), expected));
      last = allBands(banded->statistics());
      if (i == 0) first = last;
    }
    CHECK(last > first); // a draw alone takes longer than this
  }
}

TEST_CASE("bands: a limit that no draw reaches changes no call") {
  FaultyContext context;
  for (const char* name : {"epipolar, two lights", "exact, lamp, all targets", "detect, a part"}) {
    CAPTURE(name);
    std::vector<std::string> calls;
    for (const double milliseconds : {0.0, 10000.0}) {
      const std::unique_ptr<Effect> effect = effectOf(context, milliseconds);
      Stage stage(tests::frameCase(name));
      stage.draw(*effect);
      context.resetCounts();
      stage.draw(*effect);
      calls.push_back(context.callsByName());
      CHECK(countOf(Call::Flush) + countOf(Call::Scissor) + countOf(Call::ScissorIndexed) == 0);
    }
    CHECK(calls[0] == calls[1]);
  }
}

TEST_CASE("bands: one draw, box and flush each, and no object in frames like those before") {
  constexpr int kWarm = 10, kFrames = 3;
  FaultyContext context;
  for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery})
    for (const char* name :
         {"epipolar, two lights", "epipolar, spread", "tree", "exact, two lights", "objects, a part"}) {
      CAPTURE(name, static_cast<int>(timing));
      const std::unique_ptr<Effect> effect = effectOf(context, kSquares, timing);
      Stage stage(tests::frameCase(name));
      for (int i = 0; i < kWarm + kFrames; ++i) {
        if (i == kWarm) context.resetCounts();
        REQUIRE(effect->render(stage.frame()));
        stage.advance();
      }
      CHECK(context.counts().objects() == 0);
      CHECK(context.counts().gpuWaits.empty());
      context.resetCounts();
      REQUIRE(effect->render(stage.frame()));
      const int drawn = draws(), boxes = countOf(Call::Scissor) + countOf(Call::ScissorIndexed);
      const int flushes = countOf(Call::Flush);
      int bands = 0, banded = 0, split = 0;
      for (const PassStatistics& pass : effect->statistics().passes) {
        CHECK((pass.bands == 0) == !pass.skipped.empty());
        bands += pass.bands;
        if (pass.bands > 1) banded += pass.bands, ++split;
      }
      CHECK(split > 1);
      CHECK(drawn == bands);
      CHECK(boxes == banded + 1); // the engine's own is given back
      CHECK(flushes < bands);
      CHECK(flushes >= banded - split);
    }
}

TEST_CASE("bands: the longest of a pass is part of its time") {
  FaultyContext context;
  for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery, PassTiming::Finish}) {
    const std::unique_ptr<Effect> effect = effectOf(context, kSquares, timing);
    Stage stage(tests::frameCase("exact"));
    stage.draw(*effect);
    for (const PassStatistics& pass : effect->statistics().passes) {
      if (!pass.skipped.empty()) continue;
      CAPTURE(pass.name, static_cast<int>(timing), pass.bands);
      CHECK(pass.bands >= 1);
      CHECK((pass.longestBand > 0) == (timing != PassTiming::Off));
      CHECK(pass.longestBand * pass.bands >= pass.milliseconds * 0.999999);
      if (pass.bands == 1)
        CHECK(pass.longestBand == pass.milliseconds);
      else
        CHECK((pass.longestBand < pass.milliseconds || timing == PassTiming::Off));
    }
  }
}
