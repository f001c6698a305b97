// How much of each frame was drawn anew, as the GPU counted it: known some frames later, and never waited for but by
// who asks for the last frame's.
#pragma once

#include "gl/Objects.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace tyndall {

/// What a frame may draw anew, and where it is counted.
struct RedrawCount {
  std::uint64_t segments = 0;            ///< of 16 samples, over all lights
  std::uint64_t changed = 0;             ///< of these, those that are drawn for certain
  std::vector<const gl::Query*> queries; ///< and what counts the others
  bool mayReuse = false;                 ///< the frame was compared with the one before
};

class RedrawCounts {
public:
  explicit RedrawCounts(const gl::Functions& gl) : gl_(gl) {}

  /// A query that no frame under way needs.
  const gl::Query& unusedQuery();

  /// A frame was drawn.
  void add(RedrawCount count);

  /// The shares of frames that are counted by now, oldest first, each once; of those that may reuse.
  std::vector<double> takeCounted();

  /// Of the last frame; waits for the GPU.
  double lastShare();

private:
  struct Frame {
    RedrawCount count;
    bool taken = false;
  };
  bool read(RedrawCount& count, bool waits); // true if all is known
  static double shareOf(const RedrawCount& count);

  static constexpr std::size_t kMostFrames = 8; // under way; beyond them the oldest is not asked for any more
  const gl::Functions& gl_;
  std::deque<gl::Query> queries_;
  std::vector<const gl::Query*> planned_; // handed out since the last frame was added
  std::deque<Frame> frames_;              // the last one stays
};

/// Frames that reuse nothing are not kept: 1 frame after the second such in a row, then 2, 4, 8, 16.
class Rests {
public:
  /// A frame that could have reused drew that share of itself anew.
  void judge(double redrawnShare, double fullShare);

  /// True if the frame is to be drawn as if nothing were kept.
  bool takeOne();

private:
  bool busy_ = false;
  int rest_ = 0, pause_ = 1;
};

} // namespace tyndall
