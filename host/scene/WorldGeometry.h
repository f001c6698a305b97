// The geometry of a posed scene in world space, for fitting views and shadow maps to it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <scene/Scene.h>
#include <vector>

namespace host {

/// Every point that a triangle refers to, and the triangles as indices into the points, three each.
struct WorldGeometry {
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> triangles;

  std::array<glm::dvec3, 3> triangle(std::size_t i) const {
    return {points[triangles[3 * i]], points[triangles[3 * i + 1]], points[triangles[3 * i + 2]]};
  }
  std::size_t triangleCount() const { return triangles.size() / 3; }
};

WorldGeometry worldGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

/// Of one node, what stops light wherever it stands: opaque triangles that cast shadows.
WorldGeometry opaqueGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, int node);

/// The same, and a box around the strands of each node.
WorldGeometry visibleGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

/// All that may stand in the way of light: triangles that are not unlit, and boxes around the strands of each node and
/// around each emitter's smoke at a time and each bank of fog.
WorldGeometry blockingGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, double seconds);

/// The scene with a box for each primitive, of triangles or lines, and without textures: bounds, cameras and shadow
/// views that are fitted to it hold the scene, need not be tight, and take next to no time.
Scene boxesOf(const Scene& scene);

/// Nearest and farthest distance along -z.
struct DepthRange {
  double nearest = 0;
  double farthest = 0;
};

/// The exact view depths of the geometry inside the pyramid |x| <= -z tanHalfWidth, |y| <= -z tanHalfHeight; empty if
/// nothing is inside.
std::optional<DepthRange> depthRangeInPyramid(const WorldGeometry& geometry, const glm::dmat4& viewFromWorld,
                                              double tanHalfWidth, double tanHalfHeight);

/// The first triangle that a ray meets.
struct RayHit {
  double distance = 0; ///< in lengths of the direction
  bool front = true;   ///< the side from which its corners run counter-clockwise
};
std::optional<RayHit> firstHit(const WorldGeometry& geometry, const glm::dvec3& origin, const glm::dvec3& direction);

} // namespace host
