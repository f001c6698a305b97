#include "Convert.h"
#include "Textures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace host::gltf {

namespace {

const nlohmann::json* extension(const nlohmann::json& owner, const char* name) {
  const auto extensions = owner.find("extensions");
  if (extensions == owner.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

class MaterialConverter {
public:
  MaterialConverter(Document& document, Scene& scene)
      : document_(document), scene_(scene), textures_(document, scene.textures) {}

  TextureCoordinates convert(std::size_t index) {
    where_ = at("materials", index);
    const nlohmann::json& json = document_.element("materials", index);
    const nlohmann::json pbr = json.value("pbrMetallicRoughness", nlohmann::json::object());
    Material material;
    material.name = nameOf(json);
    const auto factor = pbr.value("baseColorFactor", std::array<double, 4>{1, 1, 1, 1});
    for (int c = 0; c < 4; ++c) {
      material.baseColour[c] = clamped(factor[static_cast<std::size_t>(c)], 1, "pbrMetallicRoughness.baseColorFactor");
    }
    material.alphaMode = alphaMode(json.value("alphaMode", "OPAQUE"));
    material.alphaCutoff = clamped(json.value("alphaCutoff", 0.5), kLargest, "alphaCutoff");
    if (const nlohmann::json* transmission = extension(json, "KHR_materials_transmission")) {
      material.transmission = clamped(transmission->value("transmissionFactor", 0.0), 1, "transmissionFactor");
    }
    material.unlit = extension(json, "KHR_materials_unlit") != nullptr;
    material.emission = emission(json);
    const TextureCoordinates coordinates = baseColourTexture(pbr, material);
    scene_.materials.push_back(std::move(material));
    return coordinates;
  }

private:
  static constexpr double kLargest = 1e30; // keeps products of two in the range of float

  float clamped(double value, double high, const char* member) {
    if (value < 0 || value > high) document_.note(where_ + "." + member, "is clamped to what is allowed");
    return static_cast<float>(std::clamp(value, 0.0, high));
  }

  AlphaMode alphaMode(const std::string& name) {
    if (name == "MASK") return AlphaMode::Mask;
    if (name == "BLEND") return AlphaMode::Blend;
    if (name != "OPAQUE") document_.note(where_ + ".alphaMode", "\"" + name + "\" is unknown and taken as OPAQUE");
    return AlphaMode::Opaque;
  }

  glm::vec3 emission(const nlohmann::json& json) {
    const nlohmann::json* extended = extension(json, "KHR_materials_emissive_strength");
    const double strength = extended == nullptr ? 1.0 : extended->value("emissiveStrength", 1.0);
    const auto factors = json.value("emissiveFactor", std::array<double, 3>{});
    glm::vec3 emission(0);
    for (int c = 0; c < 3; ++c) {
      const float factor = clamped(factors[static_cast<std::size_t>(c)], 1, "emissiveFactor");
      emission[c] = factor * clamped(strength, kLargest, "emissiveStrength");
    }
    if (emission == glm::vec3(0) || !json.contains("emissiveTexture")) return emission;
    document_.note(where_ + ".emissiveTexture", "is not supported: the material does not emit");
    return glm::vec3(0);
  }

  TextureCoordinates baseColourTexture(const nlohmann::json& pbr, Material& material) {
    TextureCoordinates coordinates;
    const auto info = pbr.find("baseColorTexture");
    if (info == pbr.end()) return coordinates;
    material.texture = textures_.load((*info)["index"].get<int>());
    coordinates.needed = material.texture >= 0;
    coordinates.texCoord = info->value("texCoord", 0);
    if (const nlohmann::json* transform = extension(*info, "KHR_texture_transform")) {
      applyTransform(*transform, coordinates);
    }
    return coordinates;
  }

  /// KHR_texture_transform: scale, then a counter-clockwise rotation (v points down), then the offset.
  static void applyTransform(const nlohmann::json& transform, TextureCoordinates& coordinates) {
    const auto offset = transform.value("offset", std::array<float, 2>{0, 0});
    const auto scale = transform.value("scale", std::array<float, 2>{1, 1});
    const float rotation = transform.value("rotation", 0.0F);
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    coordinates.offset = {offset[0], offset[1]};
    coordinates.linear = glm::mat2(c * scale[0], -s * scale[0], s * scale[1], c * scale[1]);
    coordinates.texCoord = transform.value("texCoord", coordinates.texCoord);
  }

  Document& document_;
  Scene& scene_;
  TextureLoader textures_;
  std::string where_;
};

} // namespace

std::vector<TextureCoordinates> convertMaterials(Document& document, Scene& scene) {
  MaterialConverter converter(document, scene);
  std::vector<TextureCoordinates> coordinates;
  coordinates.reserve(document.count("materials") + 1);
  for (std::size_t i = 0; i < document.count("materials"); ++i) {
    coordinates.push_back(converter.convert(i));
  }
  scene.materials.emplace_back();
  scene.materials.back().name = "default";
  coordinates.emplace_back();
  return coordinates;
}

} // namespace host::gltf
