#include "Accessors.h"
#include "Convert.h"
#include "Layout.h"

#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace host::gltf {

namespace {

std::optional<AnimationPath> pathOf(const std::string& name) {
  if (name == "translation") return AnimationPath::Translation;
  if (name == "rotation") return AnimationPath::Rotation;
  if (name == "scale") return AnimationPath::Scale;
  return std::nullopt;
}

Interpolation interpolationOf(const std::string& name) {
  if (name == "STEP") return Interpolation::Step;
  return name == "CUBICSPLINE" ? Interpolation::CubicSpline : Interpolation::Linear;
}

void refuseStride(const Document& document, const Accessor& accessor, const std::string& where) {
  if (accessor.strided) document.refuse(where, "the buffer view of an animation must not have a byteStride");
}

std::vector<float> readTimes(Document& document, int accessor, const std::string& where) {
  const Accessor source = accessorAt(document, accessor);
  if (source.components != 1 || source.componentType != kFloat) {
    document.refuse(where, "accessors[" + std::to_string(accessor) + "] must be SCALAR of floats");
  }
  refuseStride(document, source, where);
  std::vector<float> times = readFloats(document, accessor);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool increasing = i == 0 ? times[i] >= 0 : times[i] > times[i - 1];
    if (!increasing || !std::isfinite(times[i])) {
      document.refuse(where, "element " + std::to_string(i) + ": times must be finite, at least 0 and increasing");
    }
  }
  return times;
}

/// Whether an output accessor has the type that the path needs; rotations may be normalised integers.
bool isAllowedOutput(AnimationPath path, const Accessor& accessor) {
  const bool isFloat = accessor.componentType == kFloat;
  const bool isRotation = path == AnimationPath::Rotation;
  const bool isInteger = isRotation && accessor.normalized && componentSize(accessor.componentType) < 4;
  return accessor.components == (isRotation ? 4 : 3) && (isFloat || isInteger);
}

std::vector<glm::vec4> readValues(Document& document, int accessor, AnimationPath path, const std::string& where) {
  const Accessor source = accessorAt(document, accessor);
  if (!isAllowedOutput(path, source)) {
    document.refuse(where, "accessors[" + std::to_string(accessor) + "] must have a type that its path allows");
  }
  refuseStride(document, source, where);
  const std::vector<float> floats = readFloats(document, accessor);
  const std::size_t components = path == AnimationPath::Rotation ? 4 : 3;
  document.spend(source.count * sizeof(glm::vec4), where);
  std::vector<glm::vec4> values(source.count, glm::vec4(0));
  for (std::size_t i = 0; i < floats.size(); ++i) {
    if (!std::isfinite(floats[i]))
      document.refuse(where, "element " + std::to_string(i / components) + " must be finite");
    values[i / components][static_cast<int>(i % components)] = floats[i];
  }
  return values;
}

/// Rotations at the keys, not the tangents between, must be quaternions that can be normalised.
void checkRotations(const Document& document, const AnimationChannel& channel, const std::string& where) {
  const std::size_t step = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  for (std::size_t i = step / 2; i < channel.values.size(); i += step) {
    if (channel.values[i] == glm::vec4(0)) document.refuse(where, "element " + std::to_string(i) + " must not be zero");
  }
}

AnimationChannel readChannel(Document& document, const nlohmann::json& sampler, AnimationPath path,
                             const std::string& where) {
  AnimationChannel channel;
  channel.path = path;
  channel.interpolation = interpolationOf(sampler.value("interpolation", "LINEAR"));
  channel.times = readTimes(document, sampler["input"].get<int>(), where + ".input");
  channel.values = readValues(document, sampler["output"].get<int>(), path, where + ".output");
  const bool isCubic = channel.interpolation == Interpolation::CubicSpline;
  const std::size_t expected = channel.times.size() * (isCubic ? 3 : 1);
  if (isCubic && channel.times.size() < 2) document.refuse(where + ".input", "CUBICSPLINE needs two keys or more");
  if (channel.values.size() != expected) {
    document.refuse(where + ".output", "has " + std::to_string(channel.values.size()) + " elements, must have " +
                                           std::to_string(expected));
  }
  if (path == AnimationPath::Rotation) checkRotations(document, channel, where + ".output");
  return channel;
}

} // namespace

void convertAnimations(Document& document, const std::vector<int>& sceneNodes, Scene& scene) {
  std::set<std::pair<std::size_t, AnimationPath>> animated;
  for (std::size_t a = 0; a < document.count("animations"); ++a) {
    const nlohmann::json& animation = document.element("animations", a);
    std::set<std::pair<std::size_t, AnimationPath>> ofThis;
    for (std::size_t c = 0; c < animation["channels"].size(); ++c) {
      const nlohmann::json& source = animation["channels"][c];
      const nlohmann::json& target = source["target"];
      const std::string where = at(at("animations", a, "channels"), c) + ".target";
      const auto& pathName = target["path"].get_ref<const std::string&>();
      const std::optional<AnimationPath> path = pathOf(pathName);
      if (!path) document.note(where + ".path", "\"" + pathName + "\" is not animated");
      if (!path || !target.contains("node")) continue;
      const auto sampler = source["sampler"].get<std::size_t>();
      AnimationChannel channel =
          readChannel(document, animation["samplers"][sampler], *path, at(at("animations", a, "samplers"), sampler));
      const auto node = target["node"].get<std::size_t>();
      if (document.element("nodes", node).contains("matrix"))
        document.refuse(where, "a node with a matrix must not be animated");
      if (!ofThis.emplace(node, *path).second) {
        document.refuse(where, "the animation already has a channel for this node and path");
      }
      channel.node = sceneNodes[node];
      if (channel.node < 0) continue;
      if (!animated.emplace(node, *path).second) {
        document.note(where, "another animation moves the same; the later one wins");
      }
      scene.animation.push_back(std::move(channel));
    }
  }
}

} // namespace host::gltf
