#include "Check.h"

#include "Fields.h"

#include <array>
#include <string_view>

namespace host::gltf {

namespace {

/// What a file may require of us. Extensions that only change a material's look are fine, too: they are noted.
constexpr std::array<std::string_view, 3> kSupportedExtensions = {"KHR_lights_punctual", "KHR_mesh_quantization",
                                                                  "KHR_texture_transform"};
constexpr std::array<std::string_view, 3> kSupportedMaterialExtensions = {
    "KHR_materials_transmission", "KHR_materials_emissive_strength", "KHR_materials_unlit"};
constexpr std::string_view kMaterialPrefix = "KHR_materials_";

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& list, std::string_view word) {
  for (const std::string_view entry : list) {
    if (entry == word) return true;
  }
  return false;
}

void checkStrings(Fields& root, const char* key) {
  const nlohmann::json* list = root.array(key);
  if (list == nullptr) return;
  for (std::size_t i = 0; i < list->size(); ++i) {
    if (!(*list)[i].is_string()) root.document().refuse(at(key, i), "must be a string");
  }
}

void checkExtensions(Fields& root) {
  checkStrings(root, "extensionsUsed");
  checkStrings(root, "extensionsRequired");
  Document& document = root.document();
  if (const nlohmann::json* required = root.array("extensionsRequired")) {
    for (std::size_t i = 0; i < required->size(); ++i) {
      const auto& name = (*required)[i].get_ref<const std::string&>();
      if (contains(kSupportedExtensions, name) || name.rfind(kMaterialPrefix, 0) == 0) continue;
      document.refuse(at("extensionsRequired", i),
                      name + " is not supported (supported: KHR_lights_punctual, KHR_mesh_quantization, "
                             "KHR_texture_transform, KHR_materials_*)");
    }
  }
  if (const nlohmann::json* used = root.array("extensionsUsed")) {
    for (std::size_t i = 0; i < used->size(); ++i) {
      const auto& name = (*used)[i].get_ref<const std::string&>();
      if (contains(kSupportedExtensions, name) || contains(kSupportedMaterialExtensions, name)) continue;
      document.note(at("extensionsUsed", i), name + " is ignored");
    }
  }
}

} // namespace

void checkAsset(Document& document) {
  Fields root(document, document.json, "");
  nlohmann::json* object = root.object("asset", Need::Required);
  Fields asset(document, *object, "asset");
  const std::string version = asset.string("version", Need::Required);
  const bool isTwo = version.size() >= 3 && version.compare(0, 2, "2.") == 0 &&
                     version.find_first_not_of("0123456789", 2) == std::string::npos;
  if (!isTwo) asset.refuse("version", "\"" + version + "\" must be 2.x");
  if (version != "2.0") document.note("asset.version", version + " is read as 2.0");
  const std::string minVersion = asset.string("minVersion", Need::Optional);
  if (!minVersion.empty() && minVersion != "2.0") asset.refuse("minVersion", "\"" + minVersion + "\" must be 2.0");
  checkExtensions(root);
}

void check(Document& document) {
  checkAsset(document);
  checkAccessors(document);
  checkGraph(document);
  checkMaterials(document);
}

} // namespace host::gltf
