#include "Convert.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace host::gltf {

namespace {

/// The parent of each of the file's nodes, -1 for roots.
std::vector<int> parentsOf(const Document& document) {
  const std::vector<tinygltf::Node>& nodes = document.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) {
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
    const std::vector<int>& children = document.model.nodes[static_cast<std::size_t>(node)].children;
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

/// The index of the scene to show, or -1 if the file has none.
int shownScene(const Document& document) {
  if (document.model.scenes.empty()) return -1;
  return std::max(document.model.defaultScene, 0);
}

std::vector<int> sceneRoots(Document& document, const std::vector<int>& parents) {
  const int shown = shownScene(document);
  if (shown < 0) {
    if (!parents.empty()) document.note("scenes", "there are none; all root nodes are shown");
    return withoutParent(parents);
  }
  const std::vector<int>& roots = document.model.scenes[static_cast<std::size_t>(shown)].nodes;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (parents[static_cast<std::size_t>(roots[i])] < 0) continue;
    document.refuse(at(at("scenes", static_cast<std::size_t>(shown), "nodes"), i), "must be a node without a parent");
  }
  return roots;
}

glm::dquat unitRotation(Document& document, const std::string& where, const std::vector<double>& xyzw) {
  constexpr double kSloppy = 1e-3; // what rounding to 16 bits leaves
  const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const double length = glm::length(rotation);
  if (!(length > 0 && std::isfinite(length))) document.refuse(where + ".rotation", "must be a unit quaternion");
  if (std::abs(length - 1) > kSloppy) document.note(where + ".rotation", "is not a unit quaternion and is normalised");
  return rotation / length;
}

/// glTF's matrices are affine; rounding in the last row is taken out.
glm::dmat4 affineMatrix(const Document& document, const std::string& where, const std::vector<double>& values) {
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
  const tinygltf::Node& source = document.model.nodes[index];
  const nlohmann::json& json = document.json["nodes"][index];
  const std::string where = at("nodes", index);
  Node node;
  node.name = source.name;
  node.mesh = source.mesh;
  node.camera = source.camera;
  const auto vec3 = [](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
  if (!source.translation.empty()) node.translation = vec3(source.translation);
  if (!source.rotation.empty()) node.rotation = unitRotation(document, where, source.rotation);
  if (!source.scale.empty()) node.scale = vec3(source.scale);
  if (!source.matrix.empty()) {
    node.matrix = affineMatrix(document, where, source.matrix);
  }
  const nlohmann::json::json_pointer light("/extensions/KHR_lights_punctual/light");
  if (json.contains(light)) node.light = json[light].get<int>();
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
