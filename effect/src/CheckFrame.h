// Every precondition of Config and Frame, with its message. A message is one line: the field, its value and the rule.
#pragma once

#include "SharedBlocks.h"
#include "gl/Functions.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

inline constexpr float kLargestFloat = 3e38F; ///< radiance that a 32-bit float is taken to hold

/// A texture of the engine's that is drawn into.
struct TargetTexture {
  gl::Enum format = 0;       ///< 0: there is none
  float max = kLargestFloat; ///< largest radiance that the format holds
};

/// What the checks learn about a frame's textures.
struct FrameTextures {
  struct Shadow {
    int width = 0; ///< of a layer, or of a face
    int height = 0;
    int curvesSize = 0;     ///< texels per side of Light::curves, 0 without
    double rounding = 1e-6; ///< of stored depths, as a part of them
    bool floatTint = false; ///< the glass map's tint has more than 8 bits
    /// How maps are copied that passes do not read as they are (plan/MapCopies.h), a view each; then the size is the
    /// copies'.
    std::vector<blocks::CopyBlock> copies = {};
    int copySource = 0; ///< SOURCE of glsl/passes/mapCopy.frag
  };
  struct Lookup {
    int width = 0, height = 0, depths = 0; ///< 0: there is none
    TargetTexture inscatter, transmittance;
  };
  int depthSamples = 1;
  float depthRounding = 0; ///< share of a distance by which the scene depth's format rounds it
  TargetTexture colour, inscatter, transmittance;
  glm::ivec2 occlusion{0}; ///< texels of Ambient::occlusion, 0 without
  int eyeCurves = 0;       ///< texels per side of Frame::eyeCurves, 0 without
  Lookup lookup;
  std::vector<Shadow> shadows; ///< one per light, 0 x 0 without a shadow map
};

/// Checks numbers only: sizes, matrices, lights, medium, settings.
Status checkValues(const Frame& frame);

/// Checks the frame's textures in the current context: existence, target, format, size. Binds textures to
/// the active unit: call it under a StateGuard. The values must have passed.
Status checkTextures(const gl::Functions& gl, const Frame& frame, FrameTextures& textures);

} // namespace tyndall
