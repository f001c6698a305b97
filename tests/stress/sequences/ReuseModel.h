// What Frame::reuse may keep, as tyndall.h says it: a model without pictures, of which eyes are kept and what of a
// frame must be drawn anew. It follows an effect frame by frame and says of the next one what its
// Statistics::redrawnShare must be.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <tyndall/tyndall.h>
#include <vector>

namespace stress {

/// A texture, where in it, what it holds, and the version that the frame states of that.
struct Content {
  std::uint64_t place = 0, holds = 0, version = 0;
};

/// Of a frame, what decides over reuse.
struct FrameFacts {
  std::uint64_t eye = 0, frame = 0;
  tyndall::Changes changes = tyndall::Changes::Unknown;
  std::uint64_t camera = 0;     ///< of size and camera without its jitter
  std::uint64_t shared = 0;     ///< of these, medium and technique: all depends on them
  std::uint64_t everything = 0; ///< of all that the effect compares, but for textures and the jitter
  Content depth;
  std::vector<Content> maps;
  std::array<double, 2> jitter = {0, 0};
  bool namesObjects = false;
  bool namesMeshes = false; ///< whose boxes may not be known yet: then all is compared, and no version remembered
  bool drawsInParts = true; ///< Technique::Epipolar without a spread threshold
  bool isPicture = true;    ///< no debug view but Redrawn, and a medium that is seen
  int refreshFrames = 0;
  float fullShare = 0;
};

/// What Statistics::redrawnShare must be.
enum class Share { Nothing, All, Any };

/// Frames that are drawn in full and of which nothing is kept: after the second in a row that redrew more than
/// Reuse::fullShare 1, then 2, 4, 8, 16.
class Rests {
public:
  void judge(bool busy);
  bool takeOne();

private:
  bool busy_ = false;
  int rest_ = 0, pause_ = 1;
};

class ReuseModel {
public:
  struct Prediction {
    Share share = Share::Any;
    bool mixesJitters = false; ///< the picture may hold samples of other jitters' depths
    bool isLast = false;       ///< the picture is that of the eye's last frame, bit for bit
  };

  Prediction predict(const FrameFacts& frame);
  void drawn(const FrameFacts& frame, double share); ///< the frame that was predicted
  void failed(const FrameFacts& frame, tyndall::StatusCode code);

private:
  struct Eye {
    std::optional<FrameFacts> last; ///< none: the next is drawn in full
    bool sure = true;               ///< false: what is kept is not said
    bool restsKnown = true, mixed = false, resting = false, jittered = false;
    Rests rests;
    std::optional<bool> counted; ///< the last frame, which could reuse: it redrew too much
    std::uint64_t surelyUsed = 0, possiblyUsed = 0;
  };
  bool isSurelyKept(std::uint64_t id, const Eye& eye) const;
  bool isSurelyGone(std::uint64_t id, const Eye& eye) const;
  static Share compare(const FrameFacts& last, const FrameFacts& frame);

  std::map<std::uint64_t, Eye> eyes_;                ///< all that were drawn with reuse
  std::map<std::uint64_t, std::uint64_t> forgotten_; ///< when, by Changes::Unknown
  std::uint64_t clock_ = 0;
};

} // namespace stress
