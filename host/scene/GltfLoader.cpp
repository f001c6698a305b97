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

/// Scene extras: {"tyndall": {"medium": {...}, "ambient": {...}, "fog": {...}, "sky": [r, g, b]}}.
void readTyndallExtras(gltf::Document& document, Scene& scene) {
  const int shown = document.shownScene();
  if (shown < 0) return;
  const auto index = static_cast<std::size_t>(shown);
  const nlohmann::json& source = document.element("scenes", index);
  scene.name = gltf::nameOf(source);
  const auto extras = source.find("extras");
  if (extras == source.end() || !extras->is_object() || !extras->contains("tyndall")) return;
  const std::string where = gltf::at("scenes", index, "extras.tyndall");
  const std::string inFile = printable(document.file().string()) + ": " + where;
  const nlohmann::json& tyndall = (*extras)["tyndall"];
  if (!tyndall.is_object()) document.refuse(where, "must be an object");
  for (const auto& [key, value] : tyndall.items()) {
    if (key == "medium") {
      scene.medium = parseMedium(value, inFile + ".medium");
    } else if (key == "ambient") {
      scene.ambient = parseAmbient(value, inFile + ".ambient");
    } else if (key == "fog") {
      scene.fogScattering = parseFogScattering(value, inFile + ".fog");
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

Scene convert(gltf::Document& document, const LoadWatch& watch) {
  Scene scene;
  watch("textures", 0.3);
  const std::vector<gltf::TextureCoordinates> coordinates = gltf::convertMaterials(document, scene);
  watch("meshes", 0.6);
  gltf::convertMeshes(document, coordinates, scene);
  watch("nodes", 0.95);
  gltf::convertCameras(document, scene);
  gltf::convertLights(document, scene);
  const std::vector<int> sceneNodes = gltf::convertNodes(document, scene);
  gltf::convertAnimations(document, sceneNodes, scene);
  gltf::convertSmoke(document, sceneNodes, scene);
  gltf::convertFog(document, sceneNodes, scene);
  readTyndallExtras(document, scene);
  scene.files = gltf::filesOf(document);
  scene.notes = document.notes();
  return scene;
}

} // namespace

Scene loadScene(const std::filesystem::path& file) {
  return loadScene(file, [](const char*, double) {});
}

Scene loadScene(const std::filesystem::path& file, const LoadWatch& watch) {
  gltf::Document document(file);
  try {
    watch("file", 0);
    gltf::readContainer(document);
    watch("checks", 0.1);
    gltf::check(document);
    watch("buffers", 0.2);
    gltf::loadBuffers(document);
    return convert(document, watch);
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
