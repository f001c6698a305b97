// Materials, textures, samplers and images: only their look depends on them, so a broken reference becomes a note.
#include "Check.h"
#include "Fields.h"

namespace host::gltf {

namespace {

constexpr std::int64_t kMaxIndex = std::numeric_limits<std::int32_t>::max();

/// Removes a reference that leads nowhere.
void dropUnresolved(Fields& owner, const char* key, const char* collection) {
  const std::optional<std::int64_t> index = owner.integer(key, 0, kMaxIndex);
  if (!index || static_cast<std::size_t>(*index) < owner.document().count(collection)) return;
  owner.document().note(owner.path(key), std::string("there is no such element of ") + collection);
  owner.value().erase(key);
}

void checkBaseColourTexture(Fields pbr) {
  nlohmann::json* object = pbr.object("baseColorTexture");
  if (object == nullptr) return;
  Document& document = pbr.document();
  Fields info(document, *object, pbr.path("baseColorTexture"));
  info.integer("index", 0, kMaxIndex, Need::Required);
  info.integer("texCoord", 0, kMaxIndex);
  if (nlohmann::json* extensions = info.object("extensions")) {
    if (extensions->contains("KHR_texture_transform")) {
      Fields transform(document, (*extensions)["KHR_texture_transform"], info.path("extensions.KHR_texture_transform"));
      transform.numbers("offset", 2);
      transform.number("rotation");
      transform.numbers("scale", 2);
      transform.integer("texCoord", 0, kMaxIndex);
    }
  }
  dropUnresolved(info, "index", "textures");
  if (!info.has("index")) pbr.value().erase("baseColorTexture");
}

void checkMaterial(Fields material) {
  Document& document = material.document();
  material.numbers("emissiveFactor", 3);
  material.string("alphaMode", Need::Optional);
  material.number("alphaCutoff");
  if (nlohmann::json* object = material.object("pbrMetallicRoughness")) {
    Fields pbr(document, *object, material.path("pbrMetallicRoughness"));
    pbr.numbers("baseColorFactor", 4);
    checkBaseColourTexture(pbr);
  }
  nlohmann::json* extensions = material.object("extensions");
  if (extensions == nullptr) return;
  const auto checkFactor = [&](const char* extension, const char* key) {
    if (!extensions->contains(extension)) return;
    Fields(document, (*extensions)[extension], material.path("extensions") + "." + extension).number(key);
  };
  checkFactor("KHR_materials_transmission", "transmissionFactor");
  checkFactor("KHR_materials_emissive_strength", "emissiveStrength");
}

void checkImage(Fields image) {
  image.integer("bufferView", 0, kMaxIndex);
  image.string("uri", Need::Optional);
}

} // namespace

void checkMaterials(Document& document) {
  Fields root(document, document.json, "");
  root.each("images", Need::Optional, checkImage);
  root.each("samplers", Need::Optional, [](Fields sampler) {
    sampler.integer("wrapS", 0, kMaxIndex);
    sampler.integer("wrapT", 0, kMaxIndex);
  });
  root.each("textures", Need::Optional, [](Fields texture) {
    dropUnresolved(texture, "source", "images");
    dropUnresolved(texture, "sampler", "samplers");
  });
  root.each("materials", Need::Optional, checkMaterial);
}

} // namespace host::gltf
