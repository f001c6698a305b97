#include <scene/WorldGeometry.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <scene/Fog.h>
#include <scene/Smoke.h>

namespace host {

namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

void append(WorldGeometry& geometry, const Primitive& primitive, const glm::dmat4& worldFromNode) {
  std::vector<std::uint32_t> place(primitive.vertices.size(), kUnseen);
  for (const std::uint32_t index : primitive.indices) {
    if (place[index] == kUnseen) {
      place[index] = static_cast<std::uint32_t>(geometry.points.size());
      geometry.points.emplace_back(worldFromNode * glm::dvec4(primitive.vertices[index].position, 1));
    }
    geometry.triangles.push_back(place[index]);
  }
}

/// Of a box whose corner i has the high x, y or z where bit 0, 1 or 2 of i is set; fronts outside.
constexpr std::array<std::uint32_t, 36> kBoxTriangles = {0, 3, 1, 0, 2, 3, 4, 7, 6, 4, 5, 7, 0, 5, 4, 0, 1, 5,
                                                         2, 7, 3, 2, 6, 7, 0, 6, 2, 0, 4, 6, 1, 7, 5, 1, 3, 7};

glm::dvec3 cornerOf(const Bounds& box, int corner) {
  return glm::mix(box.low, box.high, glm::bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0));
}

void appendBox(WorldGeometry& geometry, const Bounds& box, const glm::dmat4& worldFromBox) {
  const auto first = static_cast<std::uint32_t>(geometry.points.size());
  for (int corner = 0; corner < 8; ++corner)
    geometry.points.emplace_back(worldFromBox * glm::dvec4(cornerOf(box, corner), 1));
  for (const std::uint32_t corner : kBoxTriangles)
    geometry.triangles.push_back(first + corner);
}

constexpr double kHuge = std::numeric_limits<double>::infinity();

bool isEmpty(const Bounds& bounds) { return bounds.low.x > bounds.high.x; }

void widen(Bounds& bounds, const Primitive& primitive) {
  for (const std::uint32_t index : primitive.indices) {
    const glm::dvec3 position(primitive.vertices[index].position);
    bounds.low = glm::min(bounds.low, position);
    bounds.high = glm::max(bounds.high, position);
  }
}

/// Around the ends of all lines of a mesh.
std::optional<Bounds> strandBounds(const Mesh& mesh) {
  Bounds bounds{glm::dvec3(kHuge), glm::dvec3(-kHuge)};
  for (const Primitive& primitive : mesh.primitives)
    if (primitive.topology == Topology::Lines) widen(bounds, primitive);
  if (isEmpty(bounds)) return std::nullopt;
  return bounds;
}

/// Lines become a diagonal, whose bounds are theirs.
Primitive boxOf(const Primitive& primitive) {
  Primitive box;
  box.topology = primitive.topology;
  box.material = primitive.material;
  box.strand = primitive.strand;
  Bounds bounds{glm::dvec3(kHuge), glm::dvec3(-kHuge)};
  widen(bounds, primitive);
  if (isEmpty(bounds) || primitive.topology == Topology::Points) return box;
  for (int corner = 0; corner < 8; ++corner) {
    box.vertices.emplace_back();
    box.vertices.back().position = cornerOf(bounds, corner);
  }
  if (primitive.topology == Topology::Lines)
    box.indices = {0, 7};
  else
    box.indices.assign(kBoxTriangles.begin(), kBoxTriangles.end());
  return box;
}

/// The triangles of a node whose material `isWanted`.
template <class IsWanted>
void appendNode(WorldGeometry& geometry, const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                std::size_t node, const IsWanted& isWanted) {
  if (scene.nodes[node].mesh < 0) return;
  for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(scene.nodes[node].mesh)].primitives)
    if (primitive.topology == Topology::Triangles &&
        isWanted(scene.materials[static_cast<std::size_t>(primitive.material)]))
      append(geometry, primitive, worldFromNode[node]);
}

template <class IsWanted>
WorldGeometry trianglesOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, const IsWanted& isWanted) {
  WorldGeometry geometry;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    appendNode(geometry, scene, worldFromNode, node, isWanted);
  return geometry;
}

void appendStrandBoxes(WorldGeometry& geometry, const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    if (scene.nodes[node].mesh < 0) continue;
    const auto bounds = strandBounds(scene.meshes[static_cast<std::size_t>(scene.nodes[node].mesh)]);
    if (bounds) appendBox(geometry, *bounds, worldFromNode[node]);
  }
}

/// A triangle cut by four planes has at most seven corners.
struct Corners {
  std::array<glm::dvec3, 8> at;
  int count = 0;
  void add(const glm::dvec3& corner) { at[count++] = corner; }
};

/// The part of a convex polygon with dot(normal, x) >= 0.
Corners cut(const Corners& polygon, const glm::dvec3& normal) {
  Corners inside;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec3 a = polygon.at[i];
    const glm::dvec3 b = polygon.at[(i + 1) % polygon.count];
    const double da = glm::dot(normal, a);
    const double db = glm::dot(normal, b);
    if (da >= 0) inside.add(a);
    if ((da >= 0) != (db >= 0)) inside.add(a + (b - a) * (da / (da - db)));
  }
  return inside;
}

} // namespace

WorldGeometry worldGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  return trianglesOf(scene, worldFromNode, [](const Material&) { return true; });
}

WorldGeometry opaqueGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, int node) {
  WorldGeometry geometry;
  appendNode(geometry, scene, worldFromNode, static_cast<std::size_t>(node), [](const Material& material) {
    return !material.unlit && !material.isGlass() && material.alphaMode == AlphaMode::Opaque;
  });
  return geometry;
}

Scene boxesOf(const Scene& scene) {
  Scene boxes;
  boxes.name = scene.name;
  boxes.nodes = scene.nodes;
  boxes.materials = scene.materials;
  boxes.cameras = scene.cameras;
  boxes.lights = scene.lights;
  boxes.smoke = scene.smoke;
  boxes.fog = scene.fog;
  boxes.animation = scene.animation;
  boxes.medium = scene.medium;
  boxes.ambient = scene.ambient;
  boxes.skyRadiance = scene.skyRadiance;
  for (const Mesh& mesh : scene.meshes) {
    boxes.meshes.push_back({mesh.name, {}});
    for (const Primitive& primitive : mesh.primitives)
      boxes.meshes.back().primitives.push_back(boxOf(primitive));
  }
  return boxes;
}

WorldGeometry visibleGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  WorldGeometry geometry = worldGeometry(scene, worldFromNode);
  appendStrandBoxes(geometry, scene, worldFromNode);
  return geometry;
}

WorldGeometry blockingGeometry(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, double seconds) {
  WorldGeometry geometry = trianglesOf(scene, worldFromNode, [](const Material& material) { return !material.unlit; });
  appendStrandBoxes(geometry, scene, worldFromNode);
  for (const SmokeEmitter& emitter : scene.smoke)
    appendBox(geometry, smokeBounds(scene, emitter, seconds), glm::dmat4(1));
  for (const Bounds& box : fogBounds(scene, worldFromNode))
    appendBox(geometry, box, glm::dmat4(1));
  return geometry;
}

std::optional<DepthRange> depthRangeInPyramid(const WorldGeometry& geometry, const glm::dmat4& viewFromWorld,
                                              double tanHalfWidth, double tanHalfHeight) {
  const std::array<glm::dvec3, 4> sides = {glm::dvec3(1, 0, -tanHalfWidth), glm::dvec3(-1, 0, -tanHalfWidth),
                                           glm::dvec3(0, 1, -tanHalfHeight), glm::dvec3(0, -1, -tanHalfHeight)};
  std::vector<glm::dvec3> viewPoints;
  viewPoints.reserve(geometry.points.size());
  for (const glm::dvec3& point : geometry.points)
    viewPoints.emplace_back(viewFromWorld * glm::dvec4(point, 1));

  DepthRange range{std::numeric_limits<double>::infinity(), -1};
  for (std::size_t i = 0; i + 2 < geometry.triangles.size(); i += 3) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners.add(viewPoints[geometry.triangles[i + k]]);
    for (const glm::dvec3& side : sides)
      corners = cut(corners, side);
    for (int k = 0; k < corners.count; ++k) {
      range.nearest = std::min(range.nearest, -corners.at[k].z);
      range.farthest = std::max(range.farthest, -corners.at[k].z);
    }
  }
  if (range.farthest < range.nearest) return std::nullopt;
  return range;
}

// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
std::optional<RayHit> firstHit(const WorldGeometry& geometry, const glm::dvec3& origin, const glm::dvec3& direction) {
  std::optional<RayHit> hit;
  for (std::size_t i = 0; i < geometry.triangleCount(); ++i) {
    const auto [a, b, c] = geometry.triangle(i);
    const glm::dvec3 p = glm::cross(direction, c - a);
    const double determinant = glm::dot(b - a, p);
    if (determinant == 0) continue;
    const glm::dvec3 s = origin - a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(c - a, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && (!hit || distance < hit->distance))
      hit = RayHit{distance, determinant > 0};
  }
  return hit;
}

} // namespace host
