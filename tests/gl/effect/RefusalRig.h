// A frame that names every kind of texture and light, and the check that a broken copy of it is refused.
#pragma once

#include "SceneRig.h"

namespace tests {

/// Lights: 0 directional with two cascades in an array map and glass, 1 point with an array map, 2 spot with a 2D map
/// and glass. Outputs and colour are filled with known values.
class RefusalRig {
public:
  static constexpr int kSize = 8;       ///< pixels per side of the frame
  static constexpr int kShadowSize = 4; ///< texels per side of every shadow map

  RefusalRig();

  tyndall::Frame frame; ///< valid

  /// The broken frame must be refused as InvalidFrame, in one line that holds all the words, without a draw and without
  /// a GL error left.
  void checkRefused(const tyndall::Frame& broken, const std::vector<std::string>& words);

  /// The broken frame must render.
  void checkAccepted(const tyndall::Frame& good);

private:
  void fillTargets();
  std::vector<float> readTargets() const;

  SceneRig scene_{kSize, kSize};
  host::GlTexture colour_, map2D_, glass2D_, glassDepth2D_;
};

} // namespace tests
