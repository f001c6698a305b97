#include "MediumFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Json.h>
#include <tyndall/atmosphere.h>
#include <utility>

namespace host {

namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const std::string& rule) {
  throw Error(where + ": " + printable(rule));
}

void requireObject(const json& value, const std::string& where, std::initializer_list<const char*> keys) {
  if (!value.is_object()) refuse(where, "must be an object");
  for (const auto& member : value.items()) {
    if (std::find(keys.begin(), keys.end(), member.key()) != keys.end()) continue;
    std::string list;
    for (const char* key : keys)
      list += (list.empty() ? "" : ", ") + std::string(key);
    refuse(where, "unknown key " + json(member.key()).dump(-1, ' ', true) + ", must be one of " + list);
  }
}

enum class Sign { NotNegative, Any };

/// Also refuses what only overflows as a float.
float coefficient(const json& value, Sign sign, const std::string& where) {
  if (!value.is_number()) refuse(where, "must be a number, in the scene's units");
  const double number = value.get<double>();
  const bool isFinite = std::abs(number) <= double(std::numeric_limits<float>::max());
  if (!isFinite || (sign == Sign::NotNegative && number < 0)) {
    refuse(where, value.dump() + " must be finite" + (sign == Sign::NotNegative ? " and not negative" : ""));
  }
  return static_cast<float>(number);
}

tyndall::Rgb parseRgb(const json& value, const std::string& where, Sign sign = Sign::NotNegative) {
  if (!value.is_array() || value.size() != 3) refuse(where, "must be 3 numbers, one for each of R, G, B");
  tyndall::Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = coefficient(value[c], sign, where + "[" + std::to_string(c) + "]");
  }
  return rgb;
}

tyndall::Phase parsePhase(const json& value, const std::string& where) {
  constexpr std::array<std::pair<const char*, tyndall::Phase>, 4> kPhases = {
      {{"isotropic", tyndall::Phase::Isotropic},
       {"rayleigh", tyndall::Phase::Rayleigh},
       {"henyey-greenstein", tyndall::Phase::HenyeyGreenstein},
       {"cornette-shanks", tyndall::Phase::CornetteShanks}}};
  for (const auto& [name, phase] : kPhases) {
    if (value == name) return phase;
  }
  refuse(where, value.dump(-1, ' ', true) + " must be isotropic, rayleigh, henyey-greenstein or cornette-shanks");
}

double parseNumber(const json& value, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    refuse(where, value.dump(-1, ' ', true) + " must be a finite number");
  }
  return value.get<double>();
}

/// The index of one of so many layers.
int parseLayer(const json& value, std::size_t layers, const std::string& where) {
  if (!value.is_number_integer() || value < 0 || value >= layers) {
    refuse(where, value.dump(-1, ' ', true) + " must be the index of one of the " + std::to_string(layers) +
                      " layers, from 0 on");
  }
  return value.get<int>();
}

tyndall::HeightLayer parseHeightLayer(const json& value, const std::string& where) {
  requireObject(value, where, {"height", "scale", "ground"});
  tyndall::HeightLayer layer;
  if (value.contains("height")) layer.height = parseNumber(value["height"], where + ".height");
  if (value.contains("ground")) layer.ground = parseNumber(value["ground"], where + ".ground");
  if (!value.contains("scale")) return layer;
  layer.scale = parseNumber(value["scale"], where + ".scale");
  if (!(layer.scale > 0)) refuse(where + ".scale", value["scale"].dump() + " must be greater than 0, world units");
  return layer;
}

tyndall::Vec3 parseUp(const json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 3) refuse(where, "must be 3 numbers");
  tyndall::Vec3 up{};
  for (std::size_t i = 0; i < 3; ++i) {
    up[i] = parseNumber(value[i], where + "[" + std::to_string(i) + "]");
  }
  if (up == tyndall::Vec3{0, 0, 0}) refuse(where, "must not be 0");
  return up;
}

void parseLayers(const json& value, tyndall::Medium& medium, const std::string& where) {
  if (value.contains("layers")) {
    const json& list = value["layers"];
    if (!list.is_array() || list.size() > tyndall::kMaxHeightLayers) {
      refuse(where + ".layers", "must be an array of at most " + std::to_string(tyndall::kMaxHeightLayers));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      medium.layers.push_back(parseHeightLayer(list[i], where + ".layers[" + std::to_string(i) + "]"));
    }
  }
  if (!value.contains("up")) return;
  medium.up = parseUp(value["up"], where + ".up");
}

float parseAsymmetry(const json& value, tyndall::Phase phase, const std::string& where) {
  const bool hasAsymmetry = phase == tyndall::Phase::HenyeyGreenstein || phase == tyndall::Phase::CornetteShanks;
  if (!hasAsymmetry) refuse(where, "only henyey-greenstein and cornette-shanks have an asymmetry");
  const float asymmetry = value.is_number() ? value.get<float>() : 1.0F;
  if (!(std::abs(asymmetry) < 1)) refuse(where, value.dump(-1, ' ', true) + " must be a number between -1 and 1");
  return asymmetry;
}

tyndall::Constituent parseConstituent(const json& value, std::size_t layers, const std::string& where) {
  requireObject(value, where, {"scattering", "phase", "g", "layer"});
  if (!value.contains("scattering")) refuse(where + ".scattering", "is missing");
  tyndall::Constituent constituent;
  constituent.scattering = parseRgb(value["scattering"], where + ".scattering");
  if (value.contains("phase")) constituent.phase = parsePhase(value["phase"], where + ".phase");
  if (value.contains("layer")) constituent.layer = parseLayer(value["layer"], layers, where + ".layer");
  if (value.contains("g")) constituent.g = parseAsymmetry(value["g"], constituent.phase, where + ".g");
  return constituent;
}

/// {"atmosphere": {...}}, in place of all else.
tyndall::Medium parseAtmosphere(const json& value, const std::string& where) {
  requireObject(value, where, {"metre", "seaLevel", "haze", "up"});
  tyndall::Atmosphere atmosphere;
  if (value.contains("metre")) atmosphere.metre = parseNumber(value["metre"], where + ".metre");
  if (!(atmosphere.metre > 0)) refuse(where + ".metre", value["metre"].dump() + " must be greater than 0, world units");
  if (value.contains("seaLevel")) atmosphere.seaLevel = parseNumber(value["seaLevel"], where + ".seaLevel");
  if (value.contains("haze")) atmosphere.haze = parseNumber(value["haze"], where + ".haze");
  if (!(atmosphere.haze >= 0)) refuse(where + ".haze", value["haze"].dump() + " must be 0 or greater");
  if (value.contains("up")) atmosphere.up = parseUp(value["up"], where + ".up");
  tyndall::Medium air = tyndall::airOf(atmosphere);
  for (const tyndall::Constituent& constituent : air.constituents) {
    for (const float sigma : constituent.scattering) {
      const bool isHeld = std::isfinite(sigma) && (sigma > 0 || atmosphere.haze == 0);
      if (!isHeld) refuse(where, "metre or haze is beyond what 32-bit floats hold");
    }
  }
  return air;
}

} // namespace

tyndall::Medium parseMedium(const json& value, const std::string& where) {
  if (value.is_object() && value.contains("atmosphere")) {
    requireObject(value, where, {"atmosphere"});
    return parseAtmosphere(value["atmosphere"], where + ".atmosphere");
  }
  requireObject(value, where,
                {"constituents", "absorption", "absorptionLayer", "farDistance", "layers", "up", "dimsBackground"});
  tyndall::Medium medium;
  parseLayers(value, medium, where);
  if (value.contains("constituents")) {
    const json& list = value["constituents"];
    if (!list.is_array() || list.size() > tyndall::kMaxConstituents) {
      refuse(where + ".constituents", "must be an array of at most " + std::to_string(tyndall::kMaxConstituents));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string field = where + ".constituents[" + std::to_string(i) + "]";
      medium.constituents.push_back(parseConstituent(list[i], medium.layers.size(), field));
    }
  }
  if (value.contains("absorption")) medium.absorption = parseRgb(value["absorption"], where + ".absorption");
  if (value.contains("absorptionLayer")) {
    medium.absorptionLayer = parseLayer(value["absorptionLayer"], medium.layers.size(), where + ".absorptionLayer");
  }
  if (value.contains("farDistance")) {
    const json& distance = value["farDistance"];
    if (!distance.is_number() || !(distance.get<double>() > 0)) {
      refuse(where + ".farDistance", distance.dump(-1, ' ', true) + " must be a number greater than 0, world units");
    }
    medium.farDistance = distance.get<double>();
  }
  if (value.contains("dimsBackground")) {
    if (!value["dimsBackground"].is_boolean()) refuse(where + ".dimsBackground", "must be true or false");
    medium.dimsBackground = value["dimsBackground"].get<bool>();
  }
  return medium;
}

FogScattering parseFogScattering(const json& value, const std::string& where) {
  requireObject(value, where, {"albedo", "phase", "g"});
  FogScattering fog;
  if (value.contains("albedo")) fog.albedo = parseRgb(value["albedo"], where + ".albedo");
  for (const float share : fog.albedo)
    if (share > 1) refuse(where + ".albedo", "must be 3 numbers from 0 to 1");
  if (value.contains("phase")) {
    fog.phase = parsePhase(value["phase"], where + ".phase");
    if (fog.phase != tyndall::Phase::HenyeyGreenstein && fog.phase != tyndall::Phase::CornetteShanks) fog.g = 0;
  }
  if (value.contains("g")) fog.g = parseAsymmetry(value["g"], fog.phase, where + ".g");
  return fog;
}

tyndall::Ambient parseAmbient(const json& value, const std::string& where) {
  requireObject(value, where, {"radiance", "harmonics"});
  tyndall::Ambient ambient;
  if (value.contains("radiance")) ambient.radiance = parseRgb(value["radiance"], where + ".radiance");
  if (!value.contains("harmonics")) return ambient;
  const json& list = value["harmonics"];
  if (!list.is_array() || list.size() > ambient.harmonics.size()) {
    refuse(where + ".harmonics", "must be an array of at most " + std::to_string(ambient.harmonics.size()));
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    ambient.harmonics[i] = parseRgb(list[i], where + ".harmonics[" + std::to_string(i) + "]", Sign::Any);
  }
  return ambient;
}

namespace {

json readJson(const std::filesystem::path& file, const std::string& name) {
  constexpr std::uint64_t kMaxBytes = 1 << 20;
  const std::vector<std::uint8_t> text = readFile(file, kMaxBytes);
  try {
    return parseJson<json>(textOf(text));
  } catch (const Error& error) {
    throw Error(name + ": is not JSON: " + error.what());
  }
}

} // namespace

tyndall::Medium loadMedium(const std::filesystem::path& file) {
  const std::string name = printable(file.string());
  return parseMedium(readJson(file, name), name + ": medium");
}

tyndall::Ambient loadAmbient(const std::filesystem::path& file) {
  const std::string name = printable(file.string());
  return parseAmbient(readJson(file, name), name + ": ambient");
}

} // namespace host
