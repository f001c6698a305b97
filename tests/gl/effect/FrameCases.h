// Frames of every kind that the effect draws in another way, small: for tests that run many of each.
#pragma once

#include "MapLayoutRig.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tests {

/// Which textures a frame is drawn into.
struct FrameTargets {
  bool colour = true, inscatter = false, transmittance = false;
};

/// What happens from a view's one frame to the next.
enum class Motion { None, Box, Mesh };

struct FrameCase {
  std::string name;
  tyndall::Technique technique = tyndall::Technique::Epipolar;
  FrameTargets targets = {};
  std::vector<tyndall::LightKind> lights = {tyndall::LightKind::Directional};
  tyndall::DebugView view = tyndall::DebugView::Composite;
  bool glass = false, bilinear = false, curves = false, fog = false, ambient = false, lookup = false, smoke = false,
       spread = false, chosen = false, bright = false, multisampled = false, versionedMesh = false;
  bool elsewhere = false; ///< the viewport is a part of larger textures, and of the depth not each pixel has a texel
  bool layered = false;   ///< targets are layers of arrays
  tyndall::Changes changes = tyndall::Changes::Unknown;
  Motion motion = Motion::None;
  int before = 0; ///< frames of the view that were drawn before the one that is looked at
  int refreshFrames = 0;
  tyndall::Tuning tuning = {};
  std::optional<Layout> layout = {}; ///< of the first light's maps; none: an array
  int maxTextureSize = 0; ///< of a FaultyContext: so little that a lamp's faces are marched one after the other
};

/// All that are told apart: techniques, targets, views, ways to reuse.
const std::vector<FrameCase>& frameCases();

/// The one of that name.
const FrameCase& frameCase(std::string_view name);

/// Of an effect that draws it, with the case's tuning.
tyndall::Config configFor(const FrameCase& frameCase, tyndall::GlLoader loader,
                          tyndall::PassTiming timing = tyndall::PassTiming::Off);

/// True if the context can draw it: curves need OpenGL 4.3, arrays of cube maps 4.0.
bool canDraw(const FrameCase& frameCase);

/// Colour, inscatter and transmittance, as they are, wanted or not; the layers of a look-up, if the case has one.
using TargetContents = std::vector<std::vector<float>>;

/// An engine with a frame of a case.
class Stage {
public:
  static constexpr int kMapSize = 32;

  explicit Stage(const FrameCase& frameCase, int width = 32, int height = 24, RigContext context = RigContext::Test);

  tyndall::Frame& frame() { return rig_.scene.frame; }

  /// Writes known values into all targets.
  void fill();
  TargetContents read() const;

  /// Back to the view's first frame, of a view that no effect knows.
  void rewind();

  /// The view's next frame: what moves has moved.
  void advance();

  /// The next frame, in which nothing moves.
  void rest();

  /// Renders this frame into targets of known values; requires an Ok status.
  TargetContents draw(tyndall::Effect& effect);

private:
  void makeTargets();
  void show(int number);
  void layMaps();
  tyndall::MovingObject reshape(int number);

  FrameCase case_;
  int width_, height_;
  ShaftRig rig_;
  int targetWidth_, targetHeight_;
  std::vector<float> values_; ///< of a target that nothing was drawn into
  int number_ = 0;
  tyndall::Light plain_; ///< the first light, with its maps in an array
  std::optional<LaidMaps> laid_;
  host::GlTexture colour_, inscatter_, transmittance_, occlusion_, lookupLight_, lookupPassed_;
  host::GlBuffer vertices_;
};

/// The pictures of a view's first frames, from rewind() on.
std::vector<TargetContents> drawFrames(Stage& stage, tyndall::Effect& effect);

/// Equality of what is too long to be printed where it fails.
template <typename Value>
bool same(const Value& a, const Value& b) {
  return a == b;
}

} // namespace tests
