#include "Convert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace host::gltf {

namespace {

std::vector<int> nodeList(const nlohmann::json& owner, const char* key) { return owner.value(key, std::vector<int>()); }

/// The parent of each of the file's nodes, -1 for roots.
std::vector<int> parentsOf(const Document& document) {
  std::vector<int> parents(document.count("nodes"), -1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    for (const int child : nodeList(document.element("nodes", i), "children")) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0) {
        document.refuse(at("nodes", i, "children"), "nodes[" + std::to_string(child) +
                                                        "] already is a child of nodes[" + std::to_string(parent) +
                                                        "]");
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

/// The nodes below `roots`, parents first. With one parent a node at most, none comes twice.
std::vector<int> nodesBelow(const Document& document, std::vector<int> roots) {
  std::reverse(roots.begin(), roots.end());
  std::vector<int> order;
  while (!roots.empty()) {
    const int node = roots.back();
    roots.pop_back();
    order.push_back(node);
    const std::vector<int> children = nodeList(document.element("nodes", node), "children");
    roots.insert(roots.end(), children.rbegin(), children.rend());
  }
  return order;
}

std::vector<int> withoutParent(const std::vector<int>& parents) {
  std::vector<int> roots;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] < 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// A node that no root leads to sits on a loop, as every node has one parent at most.
void refuseLoops(const Document& document, const std::vector<int>& parents) {
  std::vector<bool> reached(parents.size(), false);
  for (const int node : nodesBelow(document, withoutParent(parents))) {
    reached[static_cast<std::size_t>(node)] = true;
  }
  const auto loop = std::find(reached.begin(), reached.end(), false);
  if (loop == reached.end()) return;
  document.refuse(at("nodes", static_cast<std::size_t>(loop - reached.begin())), "is an ancestor of itself");
}

std::vector<int> sceneRoots(Document& document, const std::vector<int>& parents) {
  const int shown = document.shownScene();
  if (shown < 0) {
    if (!parents.empty()) document.note("scenes", "there are none; all root nodes are shown");
    return withoutParent(parents);
  }
  std::vector<int> roots = nodeList(document.element("scenes", shown), "nodes");
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (parents[static_cast<std::size_t>(roots[i])] < 0) continue;
    document.refuse(at(at("scenes", static_cast<std::size_t>(shown), "nodes"), i), "must be a node without a parent");
  }
  return roots;
}

glm::dquat unitRotation(Document& document, const std::string& where, const std::array<double, 4>& xyzw) {
  constexpr double kSloppy = 1e-3; // what rounding to 16 bits leaves
  const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const double length = glm::length(rotation);
  if (!(length > 0 && std::isfinite(length))) document.refuse(where + ".rotation", "must be a unit quaternion");
  if (std::abs(length - 1) > kSloppy) document.note(where + ".rotation", "is not a unit quaternion and is normalised");
  return rotation / length;
}

/// glTF's matrices are affine; rounding in the last row is taken out.
glm::dmat4 affineMatrix(const Document& document, const std::string& where, const std::array<double, 16>& values) {
  constexpr double kRounding = 1e-5;
  glm::dmat4 matrix = glm::make_mat4(values.data());
  for (int column = 0; column < 4; ++column) {
    const double expected = column == 3 ? 1 : 0;
    if (!(std::abs(matrix[column][3] - expected) <= kRounding)) {
      document.refuse(where + ".matrix", "its last row must be 0 0 0 1");
    }
    matrix[column][3] = expected;
  }
  return matrix;
}

Node convertNode(Document& document, std::size_t index) {
  const nlohmann::json& source = document.element("nodes", index);
  const std::string where = at("nodes", index);
  Node node;
  node.name = nameOf(source);
  node.mesh = source.value("mesh", -1);
  node.camera = source.value("camera", -1);
  const auto vec3 = [&](const char* key, double otherwise) {
    const auto v = source.value(key, std::array<double, 3>{otherwise, otherwise, otherwise});
    return glm::dvec3(v[0], v[1], v[2]);
  };
  node.translation = vec3("translation", 0);
  node.scale = vec3("scale", 1);
  if (source.contains("rotation")) {
    node.rotation = unitRotation(document, where, source["rotation"].get<std::array<double, 4>>());
  }
  if (source.contains("matrix")) {
    node.matrix = affineMatrix(document, where, source["matrix"].get<std::array<double, 16>>());
  }
  const nlohmann::json::json_pointer light("/extensions/KHR_lights_punctual/light");
  if (source.contains(light)) node.light = source[light].get<int>();
  return node;
}

} // namespace

std::vector<int> convertNodes(Document& document, Scene& scene) {
  const std::vector<int> parents = parentsOf(document);
  refuseLoops(document, parents);
  std::vector<int> sceneNodes(parents.size(), -1);
  for (const int index : nodesBelow(document, sceneRoots(document, parents))) {
    const auto file = static_cast<std::size_t>(index);
    Node node = convertNode(document, file);
    if (parents[file] >= 0) node.parent = sceneNodes[static_cast<std::size_t>(parents[file])];
    sceneNodes[file] = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
  }
  return sceneNodes;
}

} // namespace host::gltf
