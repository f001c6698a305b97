// A bounding volume hierarchy over triangles for one question that ray tracers do not answer: which triangles meet a
// convex planar region? Embree builds the tree (its surface-area heuristic, by rtcBuildBVH) and the nodes are our own,
// because Embree traverses by rays only. Boxes are floats rounded outward; the triangles stay in double.
#pragma once

#include "Embree.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace reference {

/// A convex region of a plane, as half spaces dot(normal, p - origin) >= offset. The plane itself is the first.
struct PlanarRegion {
  struct HalfSpace {
    glm::dvec3 normal{0};
    double offset = 0;
  };
  glm::dvec3 origin{0};
  glm::dvec3 planeNormal{0, 0, 1}; ///< the plane passes through the origin
  std::array<HalfSpace, 3> sides;
};

class TriangleBvh {
public:
  using Corners = std::array<glm::dvec3, 3>;

  TriangleBvh(RTCDevice device, const std::vector<Corners>& triangles);

  /// Calls visit(corners, index) for every triangle whose box may meet the region: all that do, and some others.
  template <class Visit>
  void forEachNear(const PlanarRegion& region, const Visit& visit) const {
    std::array<std::uint32_t, kMaxDepth + 1> stack;
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!mayMeet(node, region)) continue;
      if (node.count == 0) {
        stack[depth++] = node.first;
        stack[depth++] = node.second;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        visit(corners_[i], indices_[i]);
    }
  }

private:
  static constexpr std::size_t kMaxDepth = 64;
  struct Node {
    glm::vec3 centre{0};
    std::uint32_t first = 0; ///< leaf: first triangle; inner: first child
    glm::vec3 half{0};
    std::uint32_t second = 0; ///< inner: second child
    std::uint32_t count = 0;  ///< triangles of a leaf, 0 for an inner node
  };
  struct Builder;

  static bool mayMeet(const Node& node, const PlanarRegion& region) {
    const glm::dvec3 centre = glm::dvec3(node.centre) - region.origin;
    const glm::dvec3 half(node.half);
    // The slack covers rounding in the products below, which matters for boxes without thickness.
    const double slack = 1e-12 * (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z));
    if (std::abs(glm::dot(region.planeNormal, centre)) > glm::dot(glm::abs(region.planeNormal), half) + slack)
      return false;
    for (const PlanarRegion::HalfSpace& side : region.sides)
      if (glm::dot(side.normal, centre) + glm::dot(glm::abs(side.normal), half) + slack < side.offset) return false;
    return true;
  }

  std::vector<Node> nodes_;
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> indices_;
};

} // namespace reference
