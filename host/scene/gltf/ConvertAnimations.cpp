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

void refuseStride(const Document& document, int accessor, const std::string& where) {
  const int view = document.model.accessors[static_cast<std::size_t>(accessor)].bufferView;
  if (view < 0 || document.model.bufferViews[static_cast<std::size_t>(view)].byteStride == 0) return;
  document.refuse(where, "the buffer view of an animation must not have a byteStride");
}

std::vector<float> readTimes(Document& document, int accessor, const std::string& where) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  if (componentCount(source) != 1 || source.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
    document.refuse(where, "accessors[" + std::to_string(accessor) + "] must be SCALAR of floats");
  }
  refuseStride(document, accessor, where);
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
bool isAllowedOutput(AnimationPath path, const tinygltf::Accessor& accessor) {
  const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  const bool isRotation = path == AnimationPath::Rotation;
  const bool isInteger = isRotation && accessor.normalized && componentSize(accessor.componentType) < 4;
  return componentCount(accessor) == (isRotation ? 4 : 3) && (isFloat || isInteger);
}

std::vector<glm::vec4> readValues(Document& document, int accessor, AnimationPath path, const std::string& where) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  if (!isAllowedOutput(path, source)) {
    document.refuse(where, "accessors[" + std::to_string(accessor) + "] must have a type that its path allows");
  }
  refuseStride(document, accessor, where);
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

AnimationChannel readChannel(Document& document, const tinygltf::AnimationSampler& sampler, AnimationPath path,
                             const std::string& where) {
  AnimationChannel channel;
  channel.path = path;
  channel.interpolation = interpolationOf(sampler.interpolation);
  channel.times = readTimes(document, sampler.input, where + ".input");
  channel.values = readValues(document, sampler.output, path, where + ".output");
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
  std::set<std::pair<int, AnimationPath>> animated;
  for (std::size_t a = 0; a < document.model.animations.size(); ++a) {
    const tinygltf::Animation& animation = document.model.animations[a];
    std::set<std::pair<int, AnimationPath>> ofThis;
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& source = animation.channels[c];
      const std::string where = at(at("animations", a, "channels"), c) + ".target";
      const std::optional<AnimationPath> path = pathOf(source.target_path);
      if (!path) document.note(where + ".path", "\"" + source.target_path + "\" is not animated");
      if (!path || source.target_node < 0) continue;
      const std::string sampler = at(at("animations", a, "samplers"), static_cast<std::size_t>(source.sampler));
      AnimationChannel channel =
          readChannel(document, animation.samplers[static_cast<std::size_t>(source.sampler)], *path, sampler);
      const auto target = static_cast<std::size_t>(source.target_node);
      if (!document.model.nodes[target].matrix.empty())
        document.refuse(where, "a node with a matrix must not be animated");
      if (!ofThis.emplace(source.target_node, *path).second) {
        document.refuse(where, "the animation already has a channel for this node and path");
      }
      channel.node = sceneNodes[target];
      if (channel.node < 0) continue;
      if (!animated.emplace(source.target_node, *path).second) {
        document.note(where, "another animation moves the same; the later one wins");
      }
      scene.animation.push_back(std::move(channel));
    }
  }
}

} // namespace host::gltf
