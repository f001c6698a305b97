#include "Convert.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace host::gltf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 1e-6; // pi / 2 stored as a float exceeds pi / 2

std::string text(double value) { return nlohmann::json(value).dump(); }

void convertPerspective(const Document& document, const std::string& where, const nlohmann::json& lens,
                        Camera& camera) {
  const auto fov = lens["yfov"].get<double>(), near = lens["znear"].get<double>();
  if (!(fov > 0 && fov < kPi)) document.refuse(where + ".yfov", text(fov) + " must be greater than 0 and less than pi");
  if (!(near > 0)) document.refuse(where + ".znear", text(near) + " must be greater than 0");
  camera.verticalFov = fov;
  camera.nearPlane = near;
  camera.farPlane = 0;
  if (!lens.contains("zfar")) return;
  camera.farPlane = lens["zfar"].get<double>();
  if (!(camera.farPlane > near)) {
    document.refuse(where + ".zfar", text(camera.farPlane) + " must be greater than znear");
  }
}

void convertOrthographic(Document& document, const std::string& where, const nlohmann::json& lens, Camera& camera) {
  for (const char* key : {"xmag", "ymag"}) {
    const auto magnitude = lens[key].get<double>();
    if (magnitude == 0) document.refuse(where + "." + key, "must not be 0");
    if (magnitude < 0) document.note(where + "." + key, "is negative; its absolute value is taken");
  }
  const auto near = lens["znear"].get<double>(), far = lens["zfar"].get<double>();
  if (!(near >= 0)) document.refuse(where + ".znear", text(near) + " must not be negative");
  if (!(far > near)) document.refuse(where + ".zfar", text(far) + " must be greater than znear");
  camera.orthographic = true;
  camera.halfHeight = std::abs(lens["ymag"].get<double>());
  camera.nearPlane = near;
  camera.farPlane = far;
}

void convertSpot(Document& document, const std::string& where, const nlohmann::json& spot, Light& light) {
  const double inner = spot.value("innerConeAngle", 0.0);
  const double outer = spot.value("outerConeAngle", kPi / 4);
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

glm::vec3 colourOf(const Document& document, const std::string& where, const nlohmann::json& source) {
  const double intensity = source.value("intensity", 1.0);
  const auto factors = source.value("color", std::array<double, 3>{1, 1, 1});
  if (!(intensity >= 0)) document.refuse(where + ".intensity", text(intensity) + " must not be negative");
  glm::vec3 colour(1);
  for (int c = 0; c < 3; ++c) {
    const double factor = factors[static_cast<std::size_t>(c)];
    if (!(factor >= 0)) document.refuse(where + ".color", text(factor) + " must not be negative");
    colour[c] = static_cast<float>(factor * intensity);
    if (!std::isfinite(colour[c]))
      document.refuse(where + ".intensity", "colour x intensity must be finite as a float");
  }
  return colour;
}

} // namespace

void convertCameras(Document& document, Scene& scene) {
  for (std::size_t i = 0; i < document.count("cameras"); ++i) {
    const nlohmann::json& source = document.element("cameras", i);
    const auto type = source["type"].get<std::string>();
    const std::string where = at("cameras", i, type);
    Camera camera;
    camera.name = nameOf(source);
    if (type == "perspective") {
      convertPerspective(document, where, source[type], camera);
    } else {
      convertOrthographic(document, where, source[type], camera);
    }
    scene.cameras.push_back(std::move(camera));
  }
}

void convertLights(Document& document, Scene& scene) {
  for (std::size_t i = 0; i < document.lightCount(); ++i) {
    const nlohmann::json& source = document.json["extensions"]["KHR_lights_punctual"]["lights"][i];
    const std::string where = at("extensions.KHR_lights_punctual.lights", i);
    Light light;
    light.name = nameOf(source);
    light.kind = kindOf(source["type"].get_ref<const std::string&>());
    light.colour = colourOf(document, where, source);
    if (light.kind != tyndall::LightKind::Directional && source.contains("range")) {
      light.range = source["range"].get<double>();
      if (!(light.range > 0)) document.refuse(where + ".range", text(light.range) + " must be greater than 0");
    }
    if (light.kind == tyndall::LightKind::Spot) convertSpot(document, where, source["spot"], light);
    scene.lights.push_back(std::move(light));
  }
}

} // namespace host::gltf
