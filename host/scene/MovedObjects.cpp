#include "scene/MovedObjects.h"

#include "scene/Projection.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace host {

namespace {

Bounds boundsOf(const Mesh& mesh) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  Bounds bounds{glm::dvec3(kHuge), glm::dvec3(-kHuge)};
  for (const Primitive& primitive : mesh.primitives)
    for (const Vertex& vertex : primitive.vertices) {
      bounds.low = glm::min(bounds.low, glm::dvec3(vertex.position));
      bounds.high = glm::max(bounds.high, glm::dvec3(vertex.position));
    }
  return bounds.low.x <= bounds.high.x ? bounds : Bounds{};
}

// Around a mesh in its node's coordinates, with some thickness where it is flat.
glm::dmat4 nodeFromBox(const Bounds& bounds) {
  const glm::dvec3 half = 0.5 * (bounds.high - bounds.low);
  const double least = std::max(1e-4 * std::max({half.x, half.y, half.z}), 1e-9);
  const glm::dmat4 middle = glm::translate(glm::dmat4(1), 0.5 * (bounds.low + bounds.high));
  return glm::scale(middle, glm::max(half, glm::dvec3(least)));
}

// The box itself or, of a node that is scaled to nothing along an axis, one along the world's axes around it.
glm::dmat4 placed(const glm::dmat4& worldFromNode, const Bounds& bounds) {
  const glm::dmat4 box = worldFromNode * nodeFromBox(bounds);
  const double size = std::max({glm::length(box[0]), glm::length(box[1]), glm::length(box[2])});
  if (std::abs(glm::determinant(glm::dmat3(box))) > 1e-12 * size * size * size) return box;
  const glm::dvec3 reach = glm::abs(glm::dvec3(box[0])) + glm::abs(glm::dvec3(box[1])) + glm::abs(glm::dvec3(box[2]));
  const glm::dvec3 middle(box[3]);
  return nodeFromBox({middle - reach, middle + reach});
}

} // namespace

std::vector<Bounds> meshBounds(const Scene& scene) {
  std::vector<Bounds> bounds;
  bounds.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes)
    bounds.push_back(boundsOf(mesh));
  return bounds;
}

std::vector<tyndall::MovingObject> movedObjects(const Scene& scene, const std::vector<Bounds>& bounds,
                                                const std::vector<glm::dmat4>& last,
                                                const std::vector<glm::dmat4>& now) {
  std::vector<tyndall::MovingObject> objects;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const int mesh = scene.nodes[n].mesh;
    if (mesh < 0 || last[n] == now[n]) continue;
    const Bounds& box = bounds[static_cast<std::size_t>(mesh)];
    objects.push_back({toMat4(placed(now[n], box)), toMat4(placed(last[n], box))});
  }
  return objects;
}

tyndall::MovingObject movedBox(const Bounds& last, const Bounds& now) {
  return {toMat4(nodeFromBox(now)), toMat4(nodeFromBox(last))};
}

} // namespace host
