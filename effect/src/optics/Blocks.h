// Fills the uniform blocks of glsl/shared.glsl from a frame. All matrices are composed in double (DESIGN 1, rule 1).
#pragma once

#include "SharedBlocks.h"

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// What the blocks need of a frame beyond the public structs.
struct FrameSizes {
  int depthSamples = 1;    ///< samples per pixel of the scene depth
  float lightCeiling = 0;  ///< largest radiance that a light may add
  float colourMax = 0;     ///< largest radiance that Frame::colour's format holds
  float outputMax = 0;     ///< the same of Output::inscatter
  float depthRounding = 0; ///< share of a distance by which the depth's format rounds it
  glm::ivec3 lookup{0};    ///< texels and layers of Frame::lookup, 0 without
  int eyeCurves = 0;       ///< texels per side of Frame::eyeCurves, 0 without
};

/// The point that shader positions are relative to: the eye, or the middle of the near plane if orthographic, where
/// rays begin: a far plane at any distance takes nothing from floats.
glm::dvec3 cameraOrigin(const Camera& camera);

/// The frame's camera is without its jitter (optics/Jitter.h), here and elsewhere in optics.
blocks::FrameBlock frameBlock(const Frame& frame, const FrameSizes& sizes);

/// The texels of a layer of so many that show a view.
Rectangle texelsOf(const ShadowView& view, int layerWidth, int layerHeight);

/// True of a rectangle that is not set.
bool isWholeLayer(const Rectangle& rectangle);

/// shadowWidth, shadowHeight, curvesSize: texels of a layer, 0 without a shadow map or curves.
blocks::LightBlock lightBlock(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight,
                              int curvesSize = 0);

/// How far camera rays run: to the far plane or the sky, world units; with a far plane at infinity few run farther than
/// to the sky.
double farthestEnd(const blocks::FrameBlock& block);

/// The greatest value of the phase function of all constituents together, per channel, 1/sr.
glm::dvec3 peakPhase(const blocks::FrameBlock& block);

/// The least that it is sure to be.
glm::dvec3 leastPhase(const blocks::FrameBlock& block);

/// What fog before the eye scatters at most of a light's irradiance, in all, in the same unit; 0 without.
glm::dvec3 peakFog(const blocks::FrameBlock& block);

/// Extinction sigma_t = scattering of all constituents + absorption, where the density of layers is 1; 1/world unit.
glm::dvec3 extinctionOf(const Medium& medium);

/// Sum of all scattering coefficients, likewise.
glm::dvec3 scatteringOf(const Medium& medium);

/// True if a ray of light fares alike in R, G and B: equal extinction, and constituents whose shares of the scattering
/// are equal. A colour of the scattering itself is a factor of the light's.
bool isMonochrome(const Medium& medium);

} // namespace tyndall::optics
