// What each pass of the epipolar pipeline would cost if it only read and wrote its bytes.
#pragma once

#include "Technique.h"

namespace bench {

/// A pass beside its floor: a draw into targets of the same formats and size that fetches as many texels of textures of
/// the same formats and sizes, adds them up, and does nothing else. Both are medians.
struct PassFloor {
  std::string name;
  double milliseconds = 0;
  double floor = 0;
};

PassFloor sumOf(const std::vector<PassFloor>& passes);

/// Why a frame has no floors; empty if it has: technique Epipolar, one directional light, one shadow view. With
/// settings.
std::string reasonAgainstFloors(const tyndall::Frame& frame);

/// The floors of a frame's passes. Timed by the wall clock around glFinish: where the passes are timed in another way,
/// a floor also holds what a glFinish costs.
class Floors {
public:
  /// counts: of that frame, whose settings are the technique's. Throws host::Error.
  Floors(const tyndall::Frame& frame, const Counts& counts);
  ~Floors();
  Floors(const Floors&) = delete;
  Floors& operator=(const Floors&) = delete;

  /// Draws each floor once. To be called between runs of the passes, so that both see the same load on the machine.
  void run();

  /// The passes that ran, in order. Throws host::Error for one that has no floor.
  std::vector<PassFloor> beside(const std::vector<tyndall::PassStatistics>& passes) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace bench
