// What is kept of the last frame (Frame::reuse): a picture for each of the engine's views and, for each of its lights,
// what the epipolar pipeline made. Decides what of it a frame draws anew.
#pragma once

#include "ObjectBoxes.h"
#include "PassRecorder.h"
#include "Targets.h"
#include "passes/Rows.h"

#include <array>
#include <memory>
#include <vector>

namespace tyndall {

enum class Redraw { Nothing, Part, All };

/// Which textures they are, and the version of what they hold: a version belongs to its texture.
struct DepthContent {
  gl::Uint texture = 0;
  std::uint64_t version = 0;
};
struct MapContent {
  gl::Uint shadow = 0, glassColour = 0, glassDepth = 0;
  std::uint64_t version = 0;
};

/// All that a light's passes read, but for textures.
struct LightKey {
  blocks::LightBlock block{};
  Settings settings;
  FrameTextures::Shadow map;
  passes::exact::Variant variant;
  AvsmCurves curves;
};

/// One light of a view.
struct LightHistory {
  explicit LightHistory(const gl::Functions& gl)
      : kept(gl), ends{Targets(gl), Targets(gl)}, rows{Targets(gl), Targets(gl)} {}

  // What is kept: slice table, row tree, epipolar inscatter; sample ends and rows of this frame and of the last one,
  // which change sides where they are compared.
  Targets kept;
  std::array<Targets, 2> ends, rows;
  std::size_t endsSide = 0, rowsSide = 0;
  LightKey key;
  MapContent maps;
  bool valid = false; ///< of the view's last frame

  // What this frame does with it.
  Redraw redraw = Redraw::All;
  bool comparesEnds = false, comparesRows = false;
  int segments = 0, changed = 0; ///< of 16 samples, and how many are drawn; < 0: `count` knows
  gl::Query count;

  // What its passes hand to one another, as they run for all lights in turn.
  passes::slices::Out geometry;
  passes::rows::Out row;
  gl::Uint sampleEnds = 0, inscatter = 0, changedSlices = 0, changedSegments = 0;
  gl::Uint movedSlices = 0; ///< 0: all were compared

  std::array<Targets*, 5> holders() { return {&kept, &ends[0], &ends[1], &rows[0], &rows[1]}; }
  std::uint64_t bytes() const;
};

/// All that a frame reads, but for textures.
struct FrameKey {
  blocks::FrameBlock block{};
  Settings settings;
  std::vector<std::size_t> drawn; ///< indices of the lights
  std::vector<LightKey> lights;   ///< of those
};

/// True if a part of a picture can be drawn: by slices only, and against its mean inscatter (spreadThreshold) not even
/// then.
bool drawsInParts(const Frame& frame);

class ViewHistory {
public:
  ViewHistory(const gl::Functions& gl, std::uint64_t view) : targets(gl), view_(view), gl_(gl) {}

  /// True if the frame is to be drawn as if there were no history: nothing has stayed the same for some frames.
  bool rests();

  /// What the frame draws: All the whole picture, Part what the lights' plans say, Nothing nothing.
  Redraw plan(const FrameKey& key, const Frame& frame);

  /// Once the frame is drawn, or has failed. What it drew is judged when the next one begins: the GPU has counted it by
  /// then.
  void finish(const Frame& frame, bool drawn);

  /// True if the frame's objects say what changed since the last one.
  bool isFollowedBy(const Frame& frame) const { return valid_ && frame.reuse.frame == frame_ + 1; }

  /// Of the last frame; waits for what the GPU has counted.
  double redrawnShare();

  std::uint64_t view() const { return view_; }
  LightHistory& light(std::size_t index) { return *lights_[index]; }
  std::uint64_t bytes() const;

  Targets targets;         ///< inscatter, transmittance, last depth
  bool keepsDepth = false; ///< the last depth is the last frame's
  LastShapes lastShapes;   ///< of meshes among the frames' objects
  std::uint64_t age = 0;   ///< of its last use
  int frames = 0;          ///< drawn, for Reuse::refreshFrames

private:
  void planLight(const FrameKey& key, std::size_t i, const Frame& frame, bool same);
  void judge();

  std::uint64_t view_;
  const gl::Functions& gl_;
  FrameKey key_;
  std::vector<std::unique_ptr<LightHistory>> lights_; // by their index in the frame
  bool valid_ = false;
  DepthContent depth_;
  std::uint64_t frame_ = 0;
  float fullShare_ = 1;
  Redraw picture_ = Redraw::All;
  // Frames that reuse nothing are not kept: 1 frame after the second such in a row, then 2, 4, 8, 16.
  bool mayReuse_ = false; // the last frame could have, and is to be judged
  bool busy_ = false;
  int rest_ = 0, pause_ = 1;
};

/// Of up to kMostViews views; the one that was not drawn for longest makes room for a new one.
class Histories {
public:
  explicit Histories(const gl::Functions& gl) : gl_(gl) {}
  ViewHistory& of(std::uint64_t view);
  void forget(std::uint64_t view);
  std::uint64_t bytes() const;

private:
  static constexpr std::size_t kMostViews = 4;
  const gl::Functions& gl_;
  std::vector<std::unique_ptr<ViewHistory>> views_;
  std::uint64_t clock_ = 0;
};

} // namespace tyndall
