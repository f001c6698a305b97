// Frames of a case in which one call fails: each of them in turn, alone or with all after it.
#pragma once

#include "FaultyContext.h"
#include "FrameCases.h"

#include <map>
#include <string>
#include <vector>

namespace tests {

/// What broke, and at which calls.
class Findings {
public:
  void add(const std::string& what, int call) { calls_[what].push_back(call); }
  void countCall() { ++points_; }
  int points() const { return points_; } ///< calls that were let fail
  bool empty() const { return calls_.empty(); }
  std::string text() const;

private:
  std::map<std::string, std::vector<int>> calls_;
  int points_ = 0;
};

struct SweepOptions {
  Fault kind = Fault::None;
  Times times = Times::From;
  bool used = false;            ///< by an effect that has drawn another frame before
  GLenum pending = GL_NO_ERROR; ///< an error of the engine's own, which it has not asked for yet
  int firstSeed = 1, seeds = 0; ///< Times::Random
  bool inTurn = false;          ///< fresh and used effects in turn, beginning with what `used` says
};

std::string nameOf(const SweepOptions& options);

/// True if an effect's status, or an AVSM's, says what the fault is.
bool isStatusOf(Fault kind, const tyndall::Status& status);

/// True if all bits of all targets are the same.
bool bitEqual(const TargetContents& a, const TargetContents& b);

class FaultSweep {
public:
  FaultSweep(FaultyContext& context, const FrameCase& frameCase);

  /// Every call of a kind, until a frame has none left that fails. Unless the status is Ok, and with it the picture
  /// right, colour, outputs and GL state must be as they were; and the next frame must be right.
  Findings run(const SweepOptions& options);

private:
  bool runOnce(const SweepOptions& options, bool used, int call, Findings& findings);
  void drawEarlier(tyndall::Effect& effect);
  bool isExpected(const TargetContents& drawn) const;

  FaultyContext& context_;
  const FrameCase& case_;
  Stage stage_, other_;
  TargetContents before_, continued_, full_; ///< the last: with what earlier frames left, and by an effect of its own
};

} // namespace tests
