#include "TriangleBvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace reference {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

float roundDown(double x) { return std::nextafter(static_cast<float>(x), -kInf); }
float roundUp(double x) { return std::nextafter(static_cast<float>(x), kInf); }

/// What Embree's builder makes; copied into TriangleBvh's own array afterwards.
struct BuildNode {
  RTCBounds bounds[2];
  BuildNode* children[2] = {nullptr, nullptr};
  std::uint32_t triangles[RTC_BUILD_MAX_PRIMITIVES_PER_LEAF];
  std::uint32_t count = 0;
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned int, void*) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
}

void setChildren(void* node, void** children, unsigned int count, void*) {
  for (unsigned int i = 0; i < count; ++i)
    static_cast<BuildNode*>(node)->children[i] = static_cast<BuildNode*>(children[i]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
  for (unsigned int i = 0; i < count; ++i)
    static_cast<BuildNode*>(node)->bounds[i] = *bounds[i];
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode;
  leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i)
    leaf->triangles[i] = primitives[i].primID;
  return leaf;
}

RTCBuildPrimitive boxOf(const TriangleBvh::Corners& t, unsigned int index) {
  const glm::dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]);
  const glm::dvec3 high = glm::max(glm::max(t[0], t[1]), t[2]);
  return {roundDown(low.x), roundDown(low.y), roundDown(low.z), 0,
          roundUp(high.x),  roundUp(high.y),  roundUp(high.z),  index};
}

} // namespace

/// Copies Embree's tree into the flat arrays.
struct TriangleBvh::Builder {
  TriangleBvh& bvh;
  const std::vector<Corners>& triangles;

  std::uint32_t add(const BuildNode& source, const RTCBounds& bounds) {
    const auto index = static_cast<std::uint32_t>(bvh.nodes_.size());
    Node node;
    setBox(node, bounds);
    bvh.nodes_.push_back(node);
    if (source.count > 0) {
      bvh.nodes_[index].first = static_cast<std::uint32_t>(bvh.corners_.size());
      bvh.nodes_[index].count = source.count;
      for (std::uint32_t i = 0; i < source.count; ++i) {
        bvh.corners_.push_back(triangles[source.triangles[i]]);
        bvh.indices_.push_back(source.triangles[i]);
      }
      return index;
    }
    const std::uint32_t first = add(*source.children[0], source.bounds[0]);
    const std::uint32_t second = add(*source.children[1], source.bounds[1]);
    bvh.nodes_[index].first = first;
    bvh.nodes_[index].second = second;
    return index;
  }

  /// Centre and half size in float; the half size is rounded up until the box holds the bounds.
  static void setBox(Node& node, const RTCBounds& b) {
    const glm::dvec3 low(b.lower_x, b.lower_y, b.lower_z), high(b.upper_x, b.upper_y, b.upper_z);
    node.centre = glm::vec3(0.5 * (low + high));
    const glm::dvec3 half = glm::max(high - glm::dvec3(node.centre), glm::dvec3(node.centre) - low);
    node.half = {roundUp(half.x), roundUp(half.y), roundUp(half.z)};
  }
};

TriangleBvh::TriangleBvh(RTCDevice device, const std::vector<Corners>& triangles) {
  if (triangles.empty()) return;
  std::vector<RTCBuildPrimitive> boxes;
  boxes.reserve(triangles.size());
  RTCBounds bounds{kInf, kInf, kInf, 0, -kInf, -kInf, -kInf, 0};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const RTCBuildPrimitive& box = boxes.emplace_back(boxOf(triangles[i], static_cast<unsigned int>(i)));
    bounds = {std::min(bounds.lower_x, box.lower_x), std::min(bounds.lower_y, box.lower_y),
              std::min(bounds.lower_z, box.lower_z), 0,
              std::max(bounds.upper_x, box.upper_x), std::max(bounds.upper_y, box.upper_y),
              std::max(bounds.upper_z, box.upper_z), 0};
  }
  const std::unique_ptr<RTCBVHTy, void (*)(RTCBVH)> tree(rtcNewBVH(device), rtcReleaseBVH);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxDepth = kMaxDepth;
  arguments.maxLeafSize = 4;
  arguments.bvh = tree.get();
  arguments.primitives = boxes.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = boxes.size();
  arguments.createNode = createNode;
  arguments.setNodeChildren = setChildren;
  arguments.setNodeBounds = setBounds;
  arguments.createLeaf = createLeaf;
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  if (!root) throw std::runtime_error("reference: Embree could not build a hierarchy");
  Builder{*this, triangles}.add(*root, bounds);
}

} // namespace reference
