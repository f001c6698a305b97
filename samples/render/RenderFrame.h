// From options to pictures: a GL context, the scene on the GPU, the effect, and one frame after the other.
#pragma once

#include "Options.h"
#include "SceneDrawer.h"

#include <gl/Context.h>
#include <gl/RenderTargets.h>
#include <memory>
#include <scene/Scene.h>
#include <scene/View.h>
#include <tyndall/tyndall.h>
#include <vector>

namespace render {

/// Z where a pixel shows only sky.
inline constexpr float kSkyZ = 1e30F;

/// RGBA floats, row 0 at the bottom; z is the distance along the view axis.
struct Picture {
  std::vector<float> composite;
  std::vector<float> inscatter;
  std::vector<float> transmittance;
  std::vector<float> z;
};

/// Distances along the view axis, of depths as the scene's targets hold them, over (0, 1) whatever their direction.
std::vector<float> viewZ(std::vector<float> depth, const tyndall::Camera& camera, bool reversed);

/// What the effect did in one frame.
struct Measurement {
  std::vector<double> milliseconds; ///< of each timed render, wall time around glFinish, ascending
  tyndall::Statistics statistics;   ///< of the render with the median time
  std::vector<VolumeShadowStatistics> volumeShadows;

  double median() const;
};

class FrameRenderer {
public:
  /// Opens the context and loads the scene. Throws host::Error.
  explicit FrameRenderer(const Options& options);

  /// Renders a frame of the animation. Throws host::Error.
  Measurement render(int frame);

  /// The same without the effect: the scene and its maps, for others to render frame() from. Its objects are what
  /// moved since the last call.
  void draw(int frame);

  /// Reads back the last frame.
  Picture readPicture() const;

  /// The scene and the last frame as the effect saw it: its textures live until the next render().
  const host::Scene& scene() const { return drawer_->scene(); }
  const tyndall::Frame& frame() const { return frame_; }

  const host::Context& context() const { return *context_; }
  int lightCount() const { return static_cast<int>(frame_.lights.size()); }

  /// What was made up or left out, each line once.
  const host::Notes& notes() const { return notes_; }

private:
  void noteEnclosures(host::Notes& notes);
  bool isKeptOut(const tyndall::Light& light);
  void noteCutRadiance(host::Notes& notes) const;
  void resolveDepth() const;
  void restoreColour() const;
  double renderEffect(const tyndall::Frame& frame); ///< milliseconds
  Measurement measure();
  void throwGlErrors() const;

  Options options_;
  std::unique_ptr<host::Context> context_; ///< outlives all that has GL names
  host::Notes notes_;
  std::unique_ptr<SceneDrawer> drawer_;
  host::RenderTargets surfaces_;  ///< the scene before the effect
  host::RenderTargets composite_; ///< its colour, blended over
  host::GlTexture inscatter_;
  host::GlTexture transmittance_;
  std::unique_ptr<tyndall::Effect> effect_;
  tyndall::Frame frame_;
};

} // namespace render
