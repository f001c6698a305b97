#include "MediumFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Json.h>
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

/// Also refuses what only overflows as a float.
float coefficient(const json& value, const std::string& where) {
  if (!value.is_number()) refuse(where, "must be a number, 1/world unit");
  const double number = value.get<double>();
  if (!(number >= 0 && number <= double(std::numeric_limits<float>::max()))) {
    refuse(where, value.dump() + " must be finite and not negative");
  }
  return static_cast<float>(number);
}

tyndall::Rgb parseRgb(const json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 3) refuse(where, "must be 3 numbers, one for each of R, G, B");
  tyndall::Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = coefficient(value[c], where + "[" + std::to_string(c) + "]");
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

tyndall::Constituent parseConstituent(const json& value, const std::string& where) {
  requireObject(value, where, {"scattering", "phase", "g"});
  if (!value.contains("scattering")) refuse(where + ".scattering", "is missing");
  tyndall::Constituent constituent;
  constituent.scattering = parseRgb(value["scattering"], where + ".scattering");
  if (value.contains("phase")) constituent.phase = parsePhase(value["phase"], where + ".phase");
  if (!value.contains("g")) return constituent;
  const bool hasAsymmetry =
      constituent.phase == tyndall::Phase::HenyeyGreenstein || constituent.phase == tyndall::Phase::CornetteShanks;
  if (!hasAsymmetry) refuse(where + ".g", "only henyey-greenstein and cornette-shanks have an asymmetry");
  const json& g = value["g"];
  const float asymmetry = g.is_number() ? g.get<float>() : 1.0F;
  if (!(std::abs(asymmetry) < 1)) refuse(where + ".g", g.dump(-1, ' ', true) + " must be a number between -1 and 1");
  constituent.g = asymmetry;
  return constituent;
}

} // namespace

tyndall::Medium parseMedium(const json& value, const std::string& where) {
  requireObject(value, where, {"constituents", "absorption", "farDistance"});
  tyndall::Medium medium;
  if (value.contains("constituents")) {
    const json& list = value["constituents"];
    if (!list.is_array() || list.size() > tyndall::kMaxConstituents) {
      refuse(where + ".constituents", "must be an array of at most " + std::to_string(tyndall::kMaxConstituents));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      medium.constituents.push_back(parseConstituent(list[i], where + ".constituents[" + std::to_string(i) + "]"));
    }
  }
  if (value.contains("absorption")) medium.absorption = parseRgb(value["absorption"], where + ".absorption");
  if (value.contains("farDistance")) {
    const json& distance = value["farDistance"];
    if (!distance.is_number() || !(distance.get<double>() > 0)) {
      refuse(where + ".farDistance", distance.dump(-1, ' ', true) + " must be a number greater than 0, world units");
    }
    medium.farDistance = distance.get<double>();
  }
  return medium;
}

tyndall::Medium loadMedium(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = 1 << 20;
  const std::vector<std::uint8_t> text = readFile(file, kMaxBytes);
  const std::string name = printable(file.string());
  json value;
  try {
    value = parseJson<json>(textOf(text));
  } catch (const Error& error) {
    throw Error(name + ": is not JSON: " + error.what());
  }
  return parseMedium(value, name + ": medium");
}

} // namespace host
