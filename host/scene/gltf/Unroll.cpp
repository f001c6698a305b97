#include "Unroll.h"

#include <glm/geometric.hpp>

namespace host::gltf {

namespace {

/// Twice the area times the normal, in double: tiny triangles must not underflow.
glm::dvec3 areaNormal(const Primitive& triangles, std::size_t first) {
  const auto position = [&](std::size_t corner) {
    return glm::dvec3(triangles.vertices[triangles.indices[first + corner]].position);
  };
  return glm::cross(position(1) - position(0), position(2) - position(0));
}

/// A degenerate triangle has no normal; it is not seen either, so any will do.
glm::vec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? glm::vec3(v / length) : glm::vec3(0, 1, 0);
}

} // namespace

Topology topologyOf(Mode mode) {
  if (mode == Mode::Points) return Topology::Points;
  return mode < Mode::Triangles ? Topology::Lines : Topology::Triangles;
}

bool isComplete(Mode mode, std::size_t count) {
  switch (mode) {
  case Mode::Points:
    return true;
  case Mode::Lines:
    return count % 2 == 0;
  case Mode::LineLoop:
  case Mode::LineStrip:
    return count >= 2;
  case Mode::Triangles:
    return count % 3 == 0;
  default:
    return count >= 3;
  }
}

std::vector<std::uint32_t> unroll(Mode mode, const std::vector<std::uint32_t>& indices) {
  const std::size_t count = indices.size();
  std::vector<std::uint32_t> list;
  const auto add = [&](std::size_t i) { list.push_back(indices[i]); };
  switch (mode) {
  case Mode::Points:
    return indices;
  case Mode::Lines:
    return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 2)};
  case Mode::Triangles:
    return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 3)};
  case Mode::LineLoop:
  case Mode::LineStrip:
    list.reserve(2 * count);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      add(i), add(i + 1);
    }
    if (mode == Mode::LineLoop && count >= 2) add(count - 1), add(0);
    return list;
  case Mode::TriangleStrip:
    list.reserve(3 * count);
    for (std::size_t i = 0; i + 2 < count; ++i) {
      add(i), add(i + 1 + i % 2), add(i + 2 - i % 2);
    }
    return list;
  case Mode::TriangleFan:
    list.reserve(3 * count);
    for (std::size_t i = 0; i + 2 < count; ++i) {
      add(i + 1), add(i + 2), add(0);
    }
    return list;
  }
  return list;
}

void makeFlat(Primitive& triangles) {
  std::vector<Vertex> vertices;
  vertices.reserve(triangles.indices.size());
  for (std::size_t i = 0; i < triangles.indices.size(); i += 3) {
    const glm::vec3 normal = unit(areaNormal(triangles, i));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      vertices.push_back(triangles.vertices[triangles.indices[i + corner]]);
      vertices.back().normal = normal;
    }
  }
  for (std::size_t i = 0; i < triangles.indices.size(); ++i) {
    triangles.indices[i] = static_cast<std::uint32_t>(i);
  }
  triangles.vertices = std::move(vertices);
}

bool repairNormals(Primitive& triangles) {
  std::vector<glm::dvec3> sums;
  for (const Vertex& vertex : triangles.vertices) {
    if (vertex.normal == glm::vec3(0)) sums.resize(triangles.vertices.size());
  }
  if (sums.empty()) return false;
  for (std::size_t i = 0; i < triangles.indices.size(); i += 3) {
    const glm::dvec3 normal = areaNormal(triangles, i);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      sums[triangles.indices[i + corner]] += normal;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (triangles.vertices[i].normal == glm::vec3(0)) triangles.vertices[i].normal = unit(sums[i]);
  }
  return true;
}

} // namespace host::gltf
