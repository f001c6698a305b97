// A random frame in OpenGL: its textures, its pictures, and the truth about some of its pixels.
#pragma once

#include "Case.h"
#include "support/ShaftsLookup.h"

namespace stress {

/// A picture by the effect, and whether it kept to its viewport.
struct Picture {
  reference::Image inscatter, transmittance;
  bool isWithinViewport = true; ///< no texel outside the viewport was written
  std::string lookupFault;      ///< what a look-up may not hold; empty: nothing
};

class CaseRig {
public:
  /// Uploads. The effect must outlive it; the case too.
  CaseRig(const Case& made, tyndall::Effect& effect);

  /// Throws std::runtime_error with the message of a status that is not Ok.
  Picture render(const tyndall::Settings& settings);

  /// The frame as render() draws it, for changes of its numbers.
  tyndall::Frame frame;

  /// What map-exact reads: values as the textures hold them.
  const reference::MapScene& scene() const { return scene_; }

  /// Replaces the scene depth, row 0 at the bottom.
  void setDepth(const std::vector<float>& depth);

private:
  void uploadDepth(const std::vector<float>& depth, DepthForm form);
  void uploadMaps(std::size_t light);
  void uploadEyeCurves();
  std::string faultOfLookup() const;

  const Case& made_;
  tyndall::Effect& effect_;
  int width_, height_; ///< of the textures
  reference::MapScene scene_;
  std::vector<tests::LaidMaps> maps_;
  std::optional<tests::ShaftsLookup> lookup_;
  host::GlTexture depth_, inscatter_, transmittance_, eyeCurves_;
};

} // namespace stress
