// How much of a lamp's light comes past strands of hair, by geometry.
#pragma once

#include "Embree.h"

#include <glm/glm.hpp>
#include <scene/Strands.h>
#include <vector>

namespace reference {

/// Strands as chains of round cylinders with round ends. Each stops its share of the light once, however many of its
/// segments a ray meets at a joint. Embree finds the segments near a ray, distances in double precision decide.
class StrandLight {
public:
  explicit StrandLight(const host::Strands& strands);

  /// From a place to a lamp. The strand is left out that holds segment `own`, where the ray leaves it; -1: none.
  double transmittance(const glm::dvec3& place, const glm::dvec3& lamp, int own = -1) const;

  /// The mean over a disc across the light, whose middle is the place, in world units: so many rays, evenly spread.
  double meanTransmittance(const glm::dvec3& place, const glm::dvec3& lamp, int own, double diameter, int rays) const;

private:
  struct Segment {
    glm::dvec3 a{0}, b{0};
    double radius = 0, passed = 1;
    bool continues = false; ///< the strand of the segment before
  };

  std::vector<Segment> segments_;
  glm::dvec3 centre_{0}; ///< Embree's origin
  DevicePointer device_;
  ScenePointer scene_;
};

} // namespace reference
