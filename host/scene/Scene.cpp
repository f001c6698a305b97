#include "Scene.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace host {

namespace {

glm::dquat toQuaternion(const glm::vec4& xyzw) { return {xyzw.w, xyzw.x, xyzw.y, xyzw.z}; }

/// glTF 2.0 appendix C.4: spherical, along the shorter arc.
glm::dvec4 slerp(const glm::vec4& from, const glm::vec4& to, double u) {
  const glm::dquat q = glm::slerp(glm::normalize(toQuaternion(from)), glm::normalize(toQuaternion(to)), u);
  return {q.x, q.y, q.z, q.w};
}

/// glTF 2.0 appendix C.5: the cubic Hermite spline over an interval of `length` seconds, at u in [0, 1].
glm::dvec4 hermite(const glm::dvec4& from, const glm::dvec4& outTangent, const glm::dvec4& to,
                   const glm::dvec4& inTangent, double length, double u) {
  const double u2 = u * u;
  const double u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * from + length * (u3 - 2 * u2 + u) * outTangent + (3 * u2 - 2 * u3) * to +
         length * (u3 - u2) * inTangent;
}

/// The value of a channel at a time; before the first and after the last key it holds theirs.
glm::dvec4 sample(const AnimationChannel& channel, double seconds) {
  const bool isCubic = channel.interpolation == Interpolation::CubicSpline;
  const auto valueAt = [&](std::size_t key) { return channel.values[isCubic ? 3 * key + 1 : key]; };
  const auto next = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
  if (next == channel.times.begin()) return valueAt(0);
  const auto key = static_cast<std::size_t>(next - channel.times.begin()) - 1;
  if (next == channel.times.end() || channel.interpolation == Interpolation::Step) return valueAt(key);
  const double length = double(channel.times[key + 1]) - channel.times[key];
  const double u = (seconds - channel.times[key]) / length;
  if (isCubic) {
    return hermite(valueAt(key), channel.values[3 * key + 2], valueAt(key + 1), channel.values[3 * (key + 1)], length,
                   u);
  }
  if (channel.path == AnimationPath::Rotation) return slerp(valueAt(key), valueAt(key + 1), u);
  return glm::mix(glm::dvec4(valueAt(key)), glm::dvec4(valueAt(key + 1)), u);
}

void apply(const AnimationChannel& channel, double seconds, Node& node) {
  const glm::dvec4 value = sample(channel, seconds);
  switch (channel.path) {
  case AnimationPath::Translation:
    node.translation = value;
    break;
  case AnimationPath::Scale:
    node.scale = value;
    break;
  case AnimationPath::Rotation:
    const double length = glm::length(value); // a spline between opposite quaternions passes through zero
    if (length > 0) node.rotation = glm::dquat(value.w, value.x, value.y, value.z) / length;
    break;
  }
}

glm::dmat4 parentFromNode(const Node& node) {
  if (node.matrix) return *node.matrix;
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), node.translation);
  return glm::scale(moved * glm::mat4_cast(node.rotation), node.scale);
}

} // namespace

std::vector<glm::dmat4> poseAt(const Scene& scene, double seconds) {
  std::vector<Node> moved;
  if (!scene.animation.empty()) moved = scene.nodes;
  for (const AnimationChannel& channel : scene.animation) {
    apply(channel, seconds, moved[static_cast<std::size_t>(channel.node)]);
  }
  const std::vector<Node>& nodes = scene.animation.empty() ? scene.nodes : moved;
  std::vector<glm::dmat4> worldFromNode;
  worldFromNode.reserve(nodes.size());
  for (const Node& node : nodes) {
    const glm::dmat4 local = parentFromNode(node);
    worldFromNode.push_back(node.parent < 0 ? local : worldFromNode[static_cast<std::size_t>(node.parent)] * local);
  }
  return worldFromNode;
}

Bounds boundsOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  constexpr double kHuge = std::numeric_limits<double>::infinity();
  Bounds bounds{glm::dvec3(kHuge), glm::dvec3(-kHuge)};
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(scene.nodes[n].mesh)].primitives) {
      if (primitive.topology == Topology::Points) continue;
      for (const std::uint32_t index : primitive.indices) {
        const glm::dvec3 position(worldFromNode[n] * glm::dvec4(primitive.vertices[index].position, 1));
        bounds.low = glm::min(bounds.low, position);
        bounds.high = glm::max(bounds.high, position);
      }
    }
  }
  return bounds.low.x <= bounds.high.x ? bounds : Bounds{};
}

} // namespace host
