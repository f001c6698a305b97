#include "scene/Strands.h"

#include <limits>

namespace host {

namespace {

constexpr double kDefaultFineness = 1.0 / 1500; ///< width over the diagonal of the bounds
constexpr double kDefaultOpacity = 0.6;

void append(Strands& strands, const Primitive& lines, const glm::vec3& albedo, const glm::dmat4& worldFromNode) {
  const std::size_t first = strands.points.size();
  for (const Vertex& vertex : lines.vertices) {
    const glm::dvec3 position(worldFromNode * glm::dvec4(vertex.position, 1));
    strands.points.push_back({position, glm::dvec3(0), lines.strand, albedo});
  }
  for (std::size_t i = 0; i + 1 < lines.indices.size(); i += 2) {
    const glm::uvec2 segment(first + lines.indices[i], first + lines.indices[i + 1]);
    StrandPoint& from = strands.points[segment.x];
    StrandPoint& to = strands.points[segment.y];
    const double length = glm::distance(from.position, to.position);
    if (!(length > 0)) continue; // covers nothing
    const glm::dvec3 direction = (to.position - from.position) / length;
    from.tangent += direction;
    to.tangent += direction;
    strands.segments.push_back(segment);
  }
  for (std::size_t i = first; i < strands.points.size(); ++i) {
    glm::dvec3& tangent = strands.points[i].tangent;
    const double length = glm::length(tangent);
    tangent = length > 1e-6 ? tangent / length : glm::dvec3(0, 1, 0); // 1e-6: a strand that turns back on itself
  }
}

} // namespace

bool hasStrands(const Scene& scene) {
  for (const Node& node : scene.nodes) {
    if (node.mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      if (primitive.topology == Topology::Lines) return true;
  }
  return false;
}

Strands strandsAt(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  Strands strands;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(scene.nodes[n].mesh)].primitives) {
      if (primitive.topology != Topology::Lines) continue;
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      append(strands, primitive, glm::vec3(material.baseColour), worldFromNode[n]);
    }
  }
  return strands;
}

Strands thinned(const Strands& strands, int of) {
  Strands some;
  some.points = strands.points;
  for (StrandPoint& point : some.points)
    point.strand.width *= of;
  int strand = -1;
  for (std::size_t i = 0; i < strands.segments.size(); ++i) {
    const bool goesOn = i > 0 && strands.segments[i].x == strands.segments[i - 1].y;
    strand += goesOn ? 0 : 1;
    if (strand % of == 0) some.segments.push_back(strands.segments[i]);
  }
  return some;
}

Strand defaultStrand(const Primitive& lines) {
  constexpr float kHuge = std::numeric_limits<float>::max();
  glm::vec3 low(kHuge);
  glm::vec3 high(-kHuge);
  for (const std::uint32_t index : lines.indices) {
    low = glm::min(low, lines.vertices[index].position);
    high = glm::max(high, lines.vertices[index].position);
  }
  const double diagonal = lines.indices.empty() ? 0 : glm::distance(glm::dvec3(low), glm::dvec3(high));
  return {diagonal > 0 ? kDefaultFineness * diagonal : kDefaultFineness, kDefaultOpacity};
}

} // namespace host
