#include "StateFile.h"
#include "RowJson.h"
#include "Tables.h"

#include <algorithm>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Json.h>
#include <scene/MediumFile.h>

namespace settings {

namespace {

Json parseJson(const std::string& text, const std::string& where) {
  try {
    return host::parseJson<Json>(text);
  } catch (const host::Error& error) {
    refuse(where, std::string("is not JSON: ") + error.what());
  }
}

Json jsonOf(const tyndall::Medium& medium) {
  Json json = jsonOf(mediumTable(), medium);
  json["constituents"] = Json::array();
  for (const tyndall::Constituent& constituent : medium.constituents)
    json["constituents"].push_back(jsonOf(constituentTable(), constituent));
  json["layers"] = Json::array();
  for (const tyndall::HeightLayer& layer : medium.layers)
    json["layers"].push_back(jsonOf(layerTable(), layer));
  return json;
}

/// As files of scenes have it (scene/MediumFile.h).
Json jsonOf(const tyndall::Ambient& ambient) {
  Json json = {{"radiance", Json::array()}, {"harmonics", Json::array()}};
  for (const Setting<tyndall::Ambient>& row : ambientTable().rows) {
    const Json value = jsonOf(row, row.get(ambient));
    if (row.field == "radiance")
      json["radiance"] = value;
    else
      json["harmonics"].push_back(value);
  }
  return json;
}

tyndall::Ambient ambientOf(const Json& json, const std::string& where) { return host::parseAmbient(json, where); }

Json jsonOf(const StateFog& fog) {
  Json json = jsonOf(fogTable(), fog);
  json["banks"] = Json::array();
  for (const host::FogBank& bank : fog.banks)
    json["banks"].push_back(jsonOf(fogBankTable(), bank));
  return json;
}

Json jsonOf(const std::vector<StateLight>& lights) {
  Json json = Json::array();
  for (const StateLight& light : lights)
    json.push_back(jsonOf(lightTable(), light));
  return json;
}

void requireList(const Json& json, std::size_t most, const std::string& where) {
  if (!json.is_array() || json.size() > most) refuse(where, fmt::format("must be a list of at most {}", most));
}

/// A list of structs, if it is there.
template <typename Owner>
void readList(const Table<Owner>& table, std::vector<Owner>& list, std::size_t most, const Json& json,
              const std::string& name, const std::string& where) {
  if (!json.contains(name)) return;
  requireList(json[name], most, where + "." + name);
  list.resize(json[name].size());
  for (std::size_t i = 0; i < list.size(); ++i)
    readInto(table, list[i], json[name][i], fmt::format("{}.{}[{}]", where, name, i));
}

tyndall::Medium mediumOf(const Json& json, const std::string& where) {
  tyndall::Medium medium;
  readInto(mediumTable(), medium, json, where, {"constituents", "layers"});
  readList(constituentTable(), medium.constituents, tyndall::kMaxConstituents, json, "constituents", where);
  readList(layerTable(), medium.layers, tyndall::kMaxHeightLayers, json, "layers", where);
  if (const std::string problem = contradictionIn(medium); !problem.empty()) refuse(where, problem);
  return medium;
}

StateFog fogOf(const Json& json, const std::string& where) {
  StateFog fog;
  readInto(fogTable(), fog, json, where, {"banks"});
  readList(fogBankTable(), fog.banks, host::kMostFogBanks, json, "banks", where);
  return fog;
}

std::vector<StateLight> lightsOf(const Json& json, const std::string& where) {
  requireList(json, tyndall::kMaxLights, where);
  std::vector<StateLight> lights(json.size());
  for (std::size_t i = 0; i < lights.size(); ++i)
    readInto(lightTable(), lights[i], json[i], fmt::format("{}[{}]", where, i));
  return lights;
}

Json cameraJson(const State& state) {
  if (state.lookAt) return jsonOf(lookAtTable(), *state.lookAt);
  return state.camera ? Json{{"scene", *state.camera}} : Json(nullptr);
}

void readCamera(State& state, const Json& json, const std::string& where) {
  if (json.is_null()) return;
  requireObject(json, where);
  if (!json.contains("scene")) {
    state.lookAt.emplace();
    return readInto(lookAtTable(), *state.lookAt, json, where);
  }
  const Json& number = json["scene"];
  constexpr int kMost = 999999;
  const bool isWhole = number.is_number_integer() && number >= 0 && number <= kMost;
  if (json.size() != 1) refuse(where, "is one of the scene's: no other field may stand there");
  if (!isWhole) refuse(where + ".scene", shown(number) + fmt::format(" must be a whole number from 0 to {}", kMost));
  state.camera = number.get<int>();
}

/// Of a State or Compared, whose settings begin as its.
template <typename Owner>
void readProfile(Owner& owner, const Json& json, const std::string& where) {
  std::string names;
  for (const Choice& choice : kProfiles) {
    names += (names.empty() ? "" : ", ") + std::string(choice.name);
    if (json != choice.name) continue;
    owner.profile = static_cast<tyndall::Profile>(choice.value);
    owner.settings = tyndall::settingsOf(owner.profile);
    return;
  }
  refuse(where, shown(json) + " must be one of " + names);
}

Json jsonOf(const Compared& compared) {
  return {{"profile", nameOf(compared.profile)}, {"settings", jsonOf(settingsTable(), compared.settings)}};
}

Compared comparedOf(const Json& json, const std::string& where) {
  requireObject(json, where);
  for (const auto& member : json.items())
    if (member.key() != "profile" && member.key() != "settings") refuse(where, "has no field " + shown(member.key()));
  Compared compared;
  if (json.contains("profile")) readProfile(compared, json["profile"], where + ".profile");
  if (json.contains("settings")) readInto(settingsTable(), compared.settings, json["settings"], where + ".settings");
  return compared;
}

Json jsonOf(const std::vector<PathPoint>& path) {
  Json json = Json::array();
  for (const PathPoint& point : path)
    json.push_back(jsonOf(pathTable(), point));
  return json;
}

std::vector<PathPoint> pathOf(const Json& json, const std::string& where) {
  requireList(json, kMostPathPoints, where);
  std::vector<PathPoint> path(json.size());
  for (std::size_t i = 0; i < path.size(); ++i)
    readInto(pathTable(), path[i], json[i], fmt::format("{}[{}]", where, i));
  return path;
}

void requireVersion(const Json& json, const std::string& where) {
  requireObject(json, where);
  if (!json.contains("version")) refuse(where, "version is missing: this is no state of the viewer's");
  if (json["version"] != kStateVersion)
    refuse(where + ": version", shown(json["version"]) + fmt::format(" must be {}", kStateVersion));
}

void requireKnown(const Json& json, const std::string& where) {
  std::vector<std::string> known = {"version", "scene", "camera", "profile",  "medium",
                                    "ambient", "fog",   "lights", "compared", "path"};
  State state;
  visitTables(state, [&](const char* name, const auto&, const auto&) { known.emplace_back(name); });
  for (const auto& member : json.items())
    if (std::find(known.begin(), known.end(), member.key()) == known.end())
      refuse(where, "has no field " + shown(member.key()));
}

std::filesystem::path sceneOf(const Json& json, const std::string& where, const std::filesystem::path& folder) {
  if (!json.contains("scene")) return {};
  const Json& name = json["scene"];
  if (!name.is_string() || name.get<std::string>().empty()) refuse(where + ": scene", "must be the name of a file");
  return (folder / name.get<std::string>()).lexically_normal();
}

} // namespace

State parseState(const std::string& text, const std::string& where, const std::filesystem::path& folder) {
  const Json json = parseJson(text, where);
  requireVersion(json, where);
  requireKnown(json, where);
  const std::string prefix = where + ": ";
  State state;
  state.scene = sceneOf(json, where, folder);
  if (json.contains("camera")) readCamera(state, json["camera"], prefix + "camera");
  if (json.contains("profile")) readProfile(state, json["profile"], prefix + "profile");
  visitTables(state, [&](const char* name, auto& part, const auto& table) {
    if (json.contains(name)) readInto(table, part, json[name], prefix + name);
  });
  if (json.contains("medium") && !json["medium"].is_null()) state.medium = mediumOf(json["medium"], prefix + "medium");
  if (json.contains("ambient") && !json["ambient"].is_null())
    state.ambient = ambientOf(json["ambient"], prefix + "ambient");
  if (json.contains("fog") && !json["fog"].is_null()) state.fog = fogOf(json["fog"], prefix + "fog");
  if (json.contains("lights") && !json["lights"].is_null()) state.lights = lightsOf(json["lights"], prefix + "lights");
  if (json.contains("compared") && !json["compared"].is_null())
    state.compared = comparedOf(json["compared"], prefix + "compared");
  if (json.contains("path")) state.path = pathOf(json["path"], prefix + "path");
  const std::string contradiction = contradictionIn(state);
  if (!contradiction.empty()) throw host::Error(prefix + contradiction);
  return state;
}

std::string textOf(const State& state, const std::filesystem::path& folder) {
  Json json = {{"version", kStateVersion}};
  if (!state.scene.empty()) {
    const std::filesystem::path scene = std::filesystem::absolute(state.scene).lexically_normal();
    json["scene"] = scene.lexically_proximate(std::filesystem::absolute(folder).lexically_normal()).string();
  }
  json["camera"] = cameraJson(state);
  json["profile"] = nameOf(state.profile);
  visitTables(state, [&](const char* name, const auto& part, const auto& table) { json[name] = jsonOf(table, part); });
  json["medium"] = state.medium ? jsonOf(*state.medium) : Json(nullptr);
  json["ambient"] = state.ambient ? jsonOf(*state.ambient) : Json(nullptr);
  json["fog"] = state.fog ? jsonOf(*state.fog) : Json(nullptr);
  json["lights"] = state.lights ? jsonOf(*state.lights) : Json(nullptr);
  json["compared"] = state.compared ? jsonOf(*state.compared) : Json(nullptr);
  json["path"] = jsonOf(state.path);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

State loadState(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = 4 << 20;
  const std::vector<std::uint8_t> bytes = host::readFile(file, kMaxBytes);
  return parseState(std::string(bytes.begin(), bytes.end()), host::printable(file.string()), file.parent_path());
}

void saveState(const std::filesystem::path& file, const State& state) {
  host::writeText(file, textOf(state, file.parent_path()));
}

tyndall::Ambient parseAmbient(const std::string& text, const std::string& where) {
  return ambientOf(parseJson(text, where), where);
}

tyndall::Medium parseMedium(const std::string& text, const std::string& where) {
  return mediumOf(parseJson(text, where), where);
}

StateFog parseFog(const std::string& text, const std::string& where) { return fogOf(parseJson(text, where), where); }

std::vector<StateLight> parseLights(const std::string& text, const std::string& where) {
  const std::vector<StateLight> lights = lightsOf(parseJson(text, where), where);
  State state;
  state.lights = lights;
  const std::string contradiction = contradictionIn(state);
  if (!contradiction.empty()) throw host::Error(where + ": " + contradiction);
  return lights;
}

std::string textOf(const tyndall::Ambient& ambient) { return shown(jsonOf(ambient)); }

std::string textOf(const tyndall::Medium& medium) { return shown(jsonOf(medium)); }

std::string textOf(const StateFog& fog) { return shown(jsonOf(fog)); }

std::string textOf(const std::vector<StateLight>& lights) { return shown(jsonOf(lights)); }

} // namespace settings
