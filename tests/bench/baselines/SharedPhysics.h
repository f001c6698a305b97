// The uniform blocks of glsl/shared.glsl as the effect itself fills them, so that baselines share its physics.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace bench {

using Bytes = std::vector<unsigned char>;

/// maxRadiance: largest finite value of the target's format.
Bytes frameBlock(const tyndall::Frame& frame, float maxRadiance);

/// shadowWidth, shadowHeight: texels, 0 without a shadow map.
Bytes lightBlock(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth, int shadowHeight);

/// From texels and depth (growing away from the light) of the light's first view to the shaders' camera space: world
/// axes, the eye as origin.
glm::dmat4 cameraFromTexel(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth, int shadowHeight);
/// True if the light's shadow map stores depth that falls away from the light.
bool isReversedMap(const tyndall::Frame& frame, const tyndall::Light& light);
glm::dmat4 clipFromCamera(const tyndall::Frame& frame);

/// How large the epipolar textures of a light are.
struct SliceShape {
  int slices = 0;
  int rowTexels = 0;                ///< of the longest row, up to a multiple of 64
  int drawnTexels = 0;              ///< of a row as strips of 64 slices draw it, as a mean
  std::uint64_t regularSamples = 0; ///< that are always marched, over all slices
};
SliceShape sliceShape(const tyndall::Frame& frame, const tyndall::Light& light, int shadowWidth, int shadowHeight);

/// True if every coefficient has the same value in R, G and B.
bool isMonochrome(const tyndall::Medium& medium);

} // namespace bench
