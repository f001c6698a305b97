#include "GltfLoader.h"

#include "gltf/Buffers.h"
#include "gltf/Check.h"
#include "gltf/Container.h"
#include "gltf/Convert.h"
#include "gltf/Extras.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <scene/Error.h>
#include <scene/MediumFile.h>

namespace host {

namespace {

/// Hands tinygltf what it needs for its model. Buffers and images are ours to bound and to load, skins are ignored, and
/// indices are left out as tinygltf refuses those without a buffer view.
void parseModel(gltf::Document& document) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [key, value] : document.json.items()) {
    if (key != "buffers" && key != "images" && key != "skins" && key != "extras") json[key] = value;
  }
  for (std::size_t mesh = 0; mesh < document.count("meshes"); ++mesh) {
    for (nlohmann::json& primitive : json["meshes"][mesh]["primitives"]) {
      primitive.erase("indices");
    }
  }
  const std::string text = json.dump();
  tinygltf::TinyGLTF parser;
  std::string error;
  std::string warning;
  const bool parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.data(),
                                                 static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
  if (!parsed) document.refuse("", error.empty() ? "is not glTF" : error);
  if (!error.empty()) document.note("tinygltf", error);
}

/// Scene extras: {"tyndall": {"medium": {...}, "sky": [r, g, b]}}.
void readTyndallExtras(gltf::Document& document, Scene& scene) {
  if (document.model.scenes.empty()) return;
  const auto index = static_cast<std::size_t>(std::max(document.model.defaultScene, 0));
  const nlohmann::json& source = document.json["scenes"][index];
  scene.name = document.model.scenes[index].name;
  const auto extras = source.find("extras");
  if (extras == source.end() || !extras->is_object() || !extras->contains("tyndall")) return;
  const std::string where = gltf::at("scenes", index, "extras.tyndall");
  const std::string inFile = printable(document.file().string()) + ": " + where;
  const nlohmann::json& tyndall = (*extras)["tyndall"];
  if (!tyndall.is_object()) document.refuse(where, "must be an object");
  for (const auto& [key, value] : tyndall.items()) {
    if (key == "medium") {
      scene.medium = parseMedium(value, inFile + ".medium");
    } else if (key == "sky") {
      const auto isRadiance = [](const nlohmann::json& v) {
        return v.is_number() && v.get<float>() >= 0 && std::isfinite(v.get<float>());
      };
      if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), isRadiance)) {
        document.refuse(where + ".sky", "must be 3 numbers, finite and not negative");
      }
      scene.skyRadiance = {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
    } else {
      document.note(where, key + " is unknown and ignored");
    }
  }
}

Scene convert(gltf::Document& document) {
  Scene scene;
  const std::vector<gltf::TextureCoordinates> coordinates = gltf::convertMaterials(document, scene);
  gltf::convertMeshes(document, coordinates, scene);
  gltf::convertCameras(document, scene);
  gltf::convertLights(document, scene);
  const std::vector<int> sceneNodes = gltf::convertNodes(document, scene);
  gltf::convertAnimations(document, sceneNodes, scene);
  gltf::convertSmoke(document, sceneNodes, scene);
  readTyndallExtras(document, scene);
  scene.files = gltf::filesOf(document);
  scene.notes = document.notes();
  return scene;
}

} // namespace

Scene loadScene(const std::filesystem::path& file) {
  gltf::Document document(file);
  try {
    gltf::readContainer(document);
    gltf::check(document);
    parseModel(document);
    gltf::loadBuffers(document);
    return convert(document);
  } catch (const nlohmann::json::exception& error) {
    document.refuse("JSON", error.what());
  } catch (const std::bad_alloc&) {
    document.refuse("", "needs more memory than there is");
  } catch (const std::length_error&) {
    document.refuse("", "needs more memory than there is");
  } catch (const std::filesystem::filesystem_error& error) {
    document.refuse("", error.what());
  }
}

} // namespace host
