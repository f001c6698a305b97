// Every precondition of Config and Frame, with its message. A message is one line: the field, its value and the rule.
#pragma once

#include "gl/Functions.h"

#include <tyndall/tyndall.h>

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
    int width = 0;
    int height = 0;
    int curvesSize = 0; ///< texels per side of Light::curves, 0 without
  };
  int depthSamples = 1;
  float depthRounding = 0; ///< share of a distance by which the scene depth's format rounds it
  TargetTexture colour, inscatter, transmittance;
  std::vector<Shadow> shadows; ///< one per light, 0 x 0 without a shadow map
};

/// Checks numbers only: sizes, matrices, lights, medium, settings.
Status checkValues(const Frame& frame);

/// Checks the frame's textures in the current context: existence, target, format, size. Binds textures to
/// the active unit: call it under a StateGuard. The values must have passed.
Status checkTextures(const gl::Functions& gl, const Frame& frame, FrameTextures& textures);

} // namespace tyndall
