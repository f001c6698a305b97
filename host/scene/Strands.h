// Hair, threads and the like: the lines of a posed scene.
#pragma once

#include "scene/Scene.h"

namespace host {

struct StrandPoint {
  glm::dvec3 position{0};
  glm::dvec3 tangent{0, 1, 0}; ///< of length 1, along the strand
  Strand strand;
  glm::vec3 albedo{1};
};

/// Strands in world space; a segment joins two of the points.
struct Strands {
  std::vector<StrandPoint> points;
  std::vector<glm::uvec2> segments;
};

bool hasStrands(const Scene& scene);

/// All lines of the scene. A point's tangent is the mean of its segments' directions, so neighbours share their ends.
Strands strandsAt(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

/// One strand of each `of` that follow each other, as many times as wide: about as much light is stopped, in a fraction
/// of the time.
Strands thinned(const Strands& strands, int of);

/// What strands of a primitive look like if nothing else is said: as fine as hair on a head that fills its bounds.
Strand defaultStrand(const Primitive& lines);

} // namespace host
