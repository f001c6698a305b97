#include "Convert.h"

#include <algorithm>
#include <cmath>

namespace host::gltf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 1e-6; // pi / 2 stored as a float exceeds pi / 2

std::string text(double value) { return nlohmann::json(value).dump(); }

void convertPerspective(const Document& document, const std::string& where, const tinygltf::PerspectiveCamera& source,
                        bool hasFar, Camera& camera) {
  if (!(source.yfov > 0 && source.yfov < kPi)) {
    document.refuse(where + ".yfov", text(source.yfov) + " must be greater than 0 and less than pi");
  }
  if (!(source.znear > 0)) document.refuse(where + ".znear", text(source.znear) + " must be greater than 0");
  if (hasFar && !(source.zfar > source.znear)) {
    document.refuse(where + ".zfar", text(source.zfar) + " must be greater than znear");
  }
  camera.verticalFov = source.yfov;
  camera.nearPlane = source.znear;
  camera.farPlane = hasFar ? source.zfar : 0;
}

void convertOrthographic(Document& document, const std::string& where, const tinygltf::OrthographicCamera& source,
                         Camera& camera) {
  for (const auto& [key, magnitude] : {std::pair("xmag", source.xmag), std::pair("ymag", source.ymag)}) {
    if (magnitude == 0) document.refuse(where + "." + key, "must not be 0");
    if (magnitude < 0) document.note(where + "." + key, "is negative; its absolute value is taken");
  }
  if (!(source.znear >= 0)) document.refuse(where + ".znear", text(source.znear) + " must not be negative");
  if (!(source.zfar > source.znear)) {
    document.refuse(where + ".zfar", text(source.zfar) + " must be greater than znear");
  }
  camera.orthographic = true;
  camera.halfHeight = std::abs(source.ymag);
  camera.nearPlane = source.znear;
  camera.farPlane = source.zfar;
}

void convertSpot(Document& document, const std::string& where, const tinygltf::SpotLight& spot, Light& light) {
  const double inner = spot.innerConeAngle;
  const double outer = spot.outerConeAngle;
  if (!(outer > 0 && outer <= kPi / 2 + kRounding)) {
    document.refuse(where + ".spot.outerConeAngle", text(outer) + " must be greater than 0 and at most pi / 2");
  }
  if (!(inner >= 0 && inner <= outer)) {
    document.refuse(where + ".spot.innerConeAngle", text(inner) + " must be from 0 to the outer angle, " + text(outer));
  }
  if (inner == outer) document.note(where + ".spot", "the cone angles are equal: its edge is sharp");
  light.innerConeAngle = std::min(inner, kPi / 2);
  light.outerConeAngle = std::min(outer, kPi / 2);
}

tyndall::LightKind kindOf(const std::string& type) {
  if (type == "point") return tyndall::LightKind::Point;
  return type == "spot" ? tyndall::LightKind::Spot : tyndall::LightKind::Directional;
}

glm::vec3 colourOf(const Document& document, const std::string& where, const tinygltf::Light& source) {
  if (!(source.intensity >= 0)) document.refuse(where + ".intensity", text(source.intensity) + " must not be negative");
  glm::vec3 colour(1);
  for (int c = 0; c < 3; ++c) {
    const double factor = source.color.size() == 3 ? source.color[static_cast<std::size_t>(c)] : 1.0;
    if (!(factor >= 0)) document.refuse(where + ".color", text(factor) + " must not be negative");
    colour[c] = static_cast<float>(factor * source.intensity);
    if (!std::isfinite(colour[c]))
      document.refuse(where + ".intensity", "colour x intensity must be finite as a float");
  }
  return colour;
}

} // namespace

void convertCameras(Document& document, Scene& scene) {
  for (std::size_t i = 0; i < document.model.cameras.size(); ++i) {
    const tinygltf::Camera& source = document.model.cameras[i];
    Camera camera;
    camera.name = source.name;
    const std::string where = at("cameras", i, source.type);
    if (source.type == "perspective") {
      const bool hasFar = document.json["cameras"][i]["perspective"].contains("zfar");
      convertPerspective(document, where, source.perspective, hasFar, camera);
    } else {
      convertOrthographic(document, where, source.orthographic, camera);
    }
    scene.cameras.push_back(std::move(camera));
  }
}

void convertLights(Document& document, Scene& scene) {
  for (std::size_t i = 0; i < document.model.lights.size(); ++i) {
    const tinygltf::Light& source = document.model.lights[i];
    const std::string where = at("extensions.KHR_lights_punctual.lights", i);
    Light light;
    light.name = source.name;
    light.kind = kindOf(source.type);
    light.colour = colourOf(document, where, source);
    const nlohmann::json& json = document.json["extensions"]["KHR_lights_punctual"]["lights"][i];
    if (light.kind != tyndall::LightKind::Directional && json.contains("range")) {
      if (!(source.range > 0)) document.refuse(where + ".range", text(source.range) + " must be greater than 0");
      light.range = source.range;
    }
    if (light.kind == tyndall::LightKind::Spot) convertSpot(document, where, source.spot, light);
    scene.lights.push_back(std::move(light));
  }
}

} // namespace host::gltf
