// Boxes and spheres of fog for tests of Avsm::drawVolumes(), and what comes through them in double precision.
#pragma once

#include "AvsmRig.h"
#include "reference/LocalVolume.h"

namespace tests {

/// A 3D texture of one channel, and what it holds.
struct DensityTexture {
  reference::DensityGrid grid;
  host::GlTexture texture = host::makeTexture();

  /// Values that the format holds exactly.
  DensityTexture(const glm::ivec3& size, const std::vector<float>& values, GLenum format = GL_R32F);
  void fill(const std::vector<float>& values);
};

/// Noise, a part of whose texels are empty, as the format holds it.
std::vector<float> noiseOf(const glm::ivec3& size, float emptyShare, GLenum format, unsigned seed);

struct Fog {
  tyndall::AvsmVolume volume;
  reference::DensityGrid grid;
};

/// The two points of a texel's ray on the near and the far plane of a light's view.
std::pair<glm::dvec3, glm::dvec3> texelRay(const tyndall::Light& light, int view, int size, int x, int y);

/// What of the light passes along it up to a depth. Light begins at `lightDepth`.
double passedBy(const std::vector<Fog>& all, const std::pair<glm::dvec3, glm::dvec3>& ray, double depth,
                double lightDepth = -1e9);

} // namespace tests
