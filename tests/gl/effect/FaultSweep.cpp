#include "FaultSweep.h"

#include "GlState.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <functional>
#include <sstream>

using namespace tyndall;

namespace tests {

namespace {

constexpr int kMostCalls = 1000; // of one kind in a frame

} // namespace

std::string Findings::text() const {
  std::ostringstream text;
  for (const auto& [what, calls] : calls_) {
    text << "\n    " << what << ": " << calls.size() << " of " << points_ << ", at";
    for (std::size_t i = 0; i < calls.size() && i < 12; ++i)
      text << " " << calls[i];
  }
  return text.str();
}

std::string nameOf(const SweepOptions& options) {
  constexpr const char* kTimes[] = {", from the k-th on", ", only the k-th", ", by the seed k"};
  return nameOf(options.kind) + std::string(kTimes[static_cast<std::size_t>(options.times)]) +
         (options.used ? ", used effect" : ", fresh effect") + (options.inTurn ? ", then the other in turn" : "");
}

bool isStatusOf(Fault kind, const Status& status) {
  switch (kind) {
  case Fault::Any:
    return isStatusOf(Fault::Link, status) || isStatusOf(Fault::Framebuffer, status);
  case Fault::Compile:
  case Fault::Link:
    return status.code == StatusCode::ShaderError;
  case Fault::Framebuffer:
    return status.code == StatusCode::OutOfMemory ||
           (status.code == StatusCode::InvalidFrame && status.message.find("Frame::") != std::string::npos);
  default:
    return status.code == StatusCode::OutOfMemory;
  }
}

bool bitEqual(const TargetContents& a, const TargetContents& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!bitEqual(a[i], b[i])) return false;
  return true;
}

FaultSweep::FaultSweep(FaultyContext& context, const FrameCase& item)
    : context_(context), case_(item), stage_(item),
      other_(frameCase(item.technique == Technique::Epipolar ? "exact, two lights" : "epipolar, two lights")) {
  context_.setMaxTextureSize(case_.maxTextureSize);
  stage_.fill();
  before_ = stage_.read();
  const std::unique_ptr<Effect> effect = newEffect(configFor(case_, context_.loader()));
  drawEarlier(*effect);
  continued_ = stage_.draw(*effect);
  full_ = stage_.draw(*newEffect(configFor(case_, context_.loader())));
}

Findings FaultSweep::run(const SweepOptions& options) {
  Findings findings;
  for (int seed = options.firstSeed; options.times == Times::Random && seed < options.firstSeed + options.seeds; ++seed)
    runOnce(options, options.used, seed, findings);
  if (options.times == Times::Random) return findings;
  bool hasFailed = true; // a used effect has fewer calls left: where it has none, a fresh one may
  for (int call = 1; call < kMostCalls; ++call) {
    const bool used = options.used != (options.inTurn && call % 2 == 0);
    const bool failed = runOnce(options, used, call, findings);
    if (!failed && (!options.inTurn || !hasFailed)) return findings;
    hasFailed = failed;
  }
  findings.add("no end of calls", kMostCalls);
  return findings;
}

// The view's frames before the one that is looked at.
void FaultSweep::drawEarlier(Effect& effect) {
  for (int i = 0; i < case_.before; ++i) {
    stage_.draw(effect);
    stage_.advance();
  }
}

bool FaultSweep::isExpected(const TargetContents& drawn) const {
  return bitEqual(drawn, full_) || bitEqual(drawn, continued_);
}

bool FaultSweep::runOnce(const SweepOptions& options, bool used, int call, Findings& findings) {
  const std::unique_ptr<Effect> effect = newEffect(configFor(case_, context_.loader()));
  if (used) other_.draw(*effect);
  stage_.rewind();
  drawEarlier(*effect);
  stage_.fill();
  const GlState stateBefore = captureGlState();
  setGlError(options.pending);
  context_.fail(options.kind, call, options.times);
  const Status status = effect->render(stage_.frame());
  if (!context_.heal()) {
    takeGlError();
    return false;
  }
  findings.countCall();
  const auto check = [&](bool fine, const std::string& what) {
    if (!fine) findings.add(what, call);
  };
  check(takeGlError() == options.pending, options.pending ? "the engine's error is lost" : "an error is left pending");
  check(testContext().takeErrors().empty(), "GL reports errors");
  check(captureGlState() == stateBefore, "state");
  const TargetContents drawn = stage_.read();
  if (status) {
    check(isExpected(drawn), "Ok, and not the picture");
  } else {
    check(isStatusOf(options.kind, status), "says " + std::to_string(static_cast<int>(status.code)));
    check(bitEqual(drawn, before_), "drawn");
  }
  // The same frame again, or the view's next one in which nothing moves.
  if (options.times == Times::From || status) stage_.rest();
  stage_.fill();
  const Status next = effect->render(stage_.frame());
  check(static_cast<bool>(next), "the next frame fails");
  const bool showsRest = status && case_.view == DebugView::Redrawn; // which is none of the pictures
  check(!next || showsRest || isExpected(stage_.read()), "the next frame differs");
  check(testContext().takeErrors().empty(), "the next frame has GL errors");
  return true;
}

} // namespace tests
