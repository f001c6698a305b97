// What is kept of the last frame (Frame::reuse): a picture for each eye, an engine's camera with the frames that it has
// shown, and, for each of its lights, what the epipolar pipeline made.
#pragma once

#include "ObjectBoxes.h"
#include "plan/Targets.h"
#include "reuse/Keys.h"
#include "reuse/RedrawCounts.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tyndall {

/// A light as the eye's last frame drew it.
struct KeptSlices {
  LightKey key;
  MapContent maps;
  Board board;
  Extent extent;
  blocks::EpipolarBlock block{};
  int viewsPerDraw = 1;
  int endsSide = 0, rowsSide = 0;
  bool mixedEnds = false; ///< of several frames' jitters
};

struct KeptLight {
  KeptLight(const gl::Functions& gl, Framebuffers& framebuffers) : targets(gl, framebuffers) {}
  Targets targets;
  std::optional<KeptSlices> last; ///< none: it is drawn whole
};

/// The picture of the eye's last frame.
struct KeptPicture {
  FrameKey key;
  DepthContent depth;
  std::uint64_t frame = 0; ///< Reuse::frame
  bool hasDepth = false;   ///< LastDepth is its depth
  Camera camera = {};      ///< without its jitter, which it names
};

/// What a frame leaves for the next one.
struct KeptNext {
  KeptPicture picture;
  std::vector<std::pair<std::size_t, KeptSlices>> lights; ///< with their index in the frame
  RedrawCount count;
};

struct KeptEye {
  KeptEye(const gl::Functions& gl, Framebuffers& framebuffers, std::uint64_t eye)
      : id(eye), targets(gl, framebuffers), counts(gl), gl_(gl), framebuffers_(framebuffers) {}
  void makeRoomFor(std::size_t lights);

  /// After a frame: what it leaves for the next one, nothing if it failed.
  void take(const Frame& frame, std::optional<KeptNext> next);

  /// The next frame is drawn whole.
  void giveUp();

  /// True if the frame's objects say what changed since the last one.
  bool isFollowedBy(const Frame& frame) const { return last && frame.reuse.frame == last->frame + 1; }
  std::uint64_t bytes() const;

  std::uint64_t id; ///< Reuse::eye
  Targets targets;
  std::optional<KeptPicture> last;                ///< none: all is drawn
  std::vector<std::unique_ptr<KeptLight>> lights; ///< by their index in the frame
  LastShapes lastShapes;                          ///< of meshes among the frames' objects
  RedrawCounts counts;
  Rests rests;
  float fullShare = 1;   ///< Reuse::fullShare of the last frame
  int frames = 0;        ///< drawn, for Reuse::refreshFrames
  std::uint64_t age = 0; ///< of its last use

private:
  const gl::Functions& gl_;
  Framebuffers& framebuffers_;
};

/// Of up to kMostEyes; the one that was not drawn for longest makes room for a new one.
class KeptEyes {
public:
  KeptEyes(const gl::Functions& gl, Framebuffers& framebuffers) : gl_(gl), framebuffers_(framebuffers) {}
  KeptEye& of(std::uint64_t id); ///< made if need be
  KeptEye* find(std::uint64_t id);
  void forget(std::uint64_t id);
  std::uint64_t bytes() const;

private:
  static constexpr std::size_t kMostEyes = 4;
  const gl::Functions& gl_;
  Framebuffers& framebuffers_;
  std::vector<std::unique_ptr<KeptEye>> eyes_;
  std::uint64_t clock_ = 0;
};

} // namespace tyndall
