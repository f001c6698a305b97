#include "GltfFile.h"
#include "support/Catch.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/MediumFile.h>
#include <tyndall/atmosphere.h>

namespace tests {

namespace {

nlohmann::json good() {
  return nlohmann::json::parse(R"({
    "constituents": [{"scattering": [0.1, 0.2, 0.3], "phase": "rayleigh"},
                     {"scattering": [1, 2, 3], "phase": "cornette-shanks", "g": -0.5},
                     {"scattering": [0, 0, 0]},
                     {"scattering": [1, 1, 1], "phase": "henyey-greenstein", "g": 0.75}],
    "absorption": [0.5, 0.25, 0],
    "farDistance": 1000})");
}

std::string refusal(const nlohmann::json& json) {
  try {
    host::parseMedium(json, "fog");
  } catch (const host::Error& error) {
    CHECK(std::string(error.what()).rfind("fog", 0) == 0);
    return error.what();
  }
  FAIL("not refused: " << json.dump());
  return {};
}

std::string refusal(const std::string& path, const nlohmann::json& value) {
  nlohmann::json json = good();
  json[nlohmann::json::json_pointer(path)] = value;
  return refusal(json);
}

std::string fileRefusal(const std::filesystem::path& file) {
  try {
    host::loadMedium(file);
  } catch (const host::Error& error) {
    return error.what();
  }
  FAIL("not refused: " << file);
  return {};
}

} // namespace

TEST_CASE("A medium is read", "[scene][medium]") {
  const tyndall::Medium medium = host::parseMedium(good(), "fog");
  REQUIRE(medium.constituents.size() == 4);
  CHECK(medium.constituents[0].scattering == tyndall::Rgb{0.1F, 0.2F, 0.3F});
  CHECK(medium.constituents[0].phase == tyndall::Phase::Rayleigh);
  CHECK(medium.constituents[1].phase == tyndall::Phase::CornetteShanks);
  CHECK(medium.constituents[1].g == -0.5F);
  CHECK(medium.constituents[2].phase == tyndall::Phase::Isotropic);
  CHECK(medium.constituents[3].phase == tyndall::Phase::HenyeyGreenstein);
  CHECK(medium.constituents[3].g == 0.75F);
  CHECK(medium.absorption == tyndall::Rgb{0.5F, 0.25F, 0});
  CHECK(medium.farDistance == 1000);
}

TEST_CASE("Everything in a medium is optional but scattering", "[scene][medium]") {
  const tyndall::Medium medium = host::parseMedium(nlohmann::json::object(), "fog");
  CHECK(medium.constituents.empty());
  CHECK(medium.absorption == tyndall::Rgb{0, 0, 0});
  CHECK(medium.farDistance == tyndall::kInfinity);
  CHECK_THAT(refusal(nlohmann::json{{"constituents", {{{"phase", "rayleigh"}}}}}),
             Catch::Contains("fog.constituents[0].scattering: is missing"));
}

TEST_CASE("A medium may be an atmosphere, and nothing else then", "[scene][medium]") {
  const nlohmann::json json = {{"atmosphere", {{"metre", 0.5}, {"seaLevel", 3}, {"haze", 2}, {"up", {0, 0, 1}}}}};
  const tyndall::Medium medium = host::parseMedium(json, "fog");
  tyndall::Atmosphere atmosphere;
  atmosphere.metre = 0.5;
  atmosphere.seaLevel = 3;
  atmosphere.haze = 2;
  atmosphere.up = {0, 0, 1};
  const tyndall::Medium air = tyndall::airOf(atmosphere);
  REQUIRE(medium.constituents.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(medium.constituents[i].scattering == air.constituents[i].scattering);
    CHECK(medium.layers[i].scale == air.layers[i].scale);
    CHECK(medium.layers[i].height == 3);
  }
  CHECK(medium.up == atmosphere.up);
  CHECK(medium.absorption == air.absorption);
  const auto refused = [](const char* field, const nlohmann::json& value) {
    return refusal(nlohmann::json{{"atmosphere", {{field, value}}}});
  };
  using Catch::Contains;
  CHECK_THAT(refused("metre", 0), Contains("fog.atmosphere.metre: 0 must be greater than 0"));
  for (const auto& [field, value] : {std::pair{"haze", 1e50}, std::pair{"metre", 1e-50}, std::pair{"metre", 1e50}})
    CHECK_THAT(refused(field, value), Contains("fog.atmosphere: metre or haze is beyond what 32-bit floats hold"));
  CHECK_THAT(refused("haze", -1), Contains("fog.atmosphere.haze: -1 must be 0 or greater"));
  CHECK_THAT(refused("seaLevel", "high"), Contains("fog.atmosphere.seaLevel: \"high\" must be a finite number"));
  CHECK_THAT(refused("up", {0, 0, 0}), Contains("fog.atmosphere.up: must not be 0"));
  CHECK_THAT(refused("planet", "Mars"), Contains("fog.atmosphere: unknown key \"planet\""));
  CHECK_THAT(refusal(nlohmann::json{{"atmosphere", nlohmann::json::object()}, {"absorption", {0, 0, 0}}}),
             Contains("unknown key \"absorption\""));
}

TEST_CASE("A medium that breaks a rule is refused by field", "[scene][medium]") {
  using Catch::Contains;
  CHECK_THAT(refusal(nlohmann::json::array()), Contains("fog: must be an object"));
  CHECK_THAT(refusal("/colour", 1), Contains("fog: unknown key \"colour\""));
  CHECK_THAT(refusal("/constituents/0/density", 1), Contains("fog.constituents[0]: unknown key \"density\""));
  CHECK_THAT(refusal("/constituents", 3), Contains("fog.constituents: must be an array of at most 4"));
  CHECK_THAT(refusal("/constituents/4", good()["constituents"][0]), Contains("at most 4"));
  CHECK_THAT(refusal("/constituents/0", 7), Contains("fog.constituents[0]: must be an object"));
  CHECK_THAT(refusal("/constituents/0/scattering", {1, 2}), Contains("scattering: must be 3 numbers"));
  CHECK_THAT(refusal("/constituents/0/scattering", 1), Contains("scattering: must be 3 numbers"));
  CHECK_THAT(refusal("/constituents/0/scattering/2", -1e-9), Contains("scattering[2]: -1e-09 must be finite"));
  CHECK_THAT(refusal("/constituents/0/scattering/1", NAN), Contains("scattering[1]"));
  CHECK_THAT(refusal("/constituents/0/scattering/1", INFINITY), Contains("scattering[1]"));
  CHECK_THAT(refusal("/constituents/0/scattering/1", 1e39), Contains("scattering[1]"));
  CHECK_THAT(refusal("/constituents/0/scattering/1", "1"), Contains("scattering[1]: must be a number"));
  CHECK_THAT(refusal("/absorption/0", -1), Contains("fog.absorption[0]"));
  CHECK_THAT(refusal("/absorption", {1, 2, 3, 4}), Contains("fog.absorption: must be 3 numbers"));
  CHECK_THAT(refusal("/constituents/0/phase", "mie"), Contains("fog.constituents[0].phase: \"mie\" must be"));
  CHECK_THAT(refusal("/constituents/0/phase", 1), Contains("fog.constituents[0].phase"));
  CHECK_THAT(refusal("/constituents/0/g", 0), Contains("fog.constituents[0].g: only"));
  CHECK_THAT(refusal("/constituents/2/g", 0.5), Contains("fog.constituents[2].g: only"));
  for (const nlohmann::json& g : {nlohmann::json(1), nlohmann::json(-1), nlohmann::json(2), nlohmann::json(NAN),
                                  nlohmann::json(0.999999999), nlohmann::json("0.5"), nlohmann::json()}) {
    CHECK_THAT(refusal("/constituents/1/g", g), Contains("fog.constituents[1].g"));
  }
  for (const nlohmann::json& distance :
       {nlohmann::json(0), nlohmann::json(-1), nlohmann::json(NAN), nlohmann::json("far")}) {
    CHECK_THAT(refusal("/farDistance", distance), Contains("fog.farDistance"));
  }
}

TEST_CASE("Ambient light is read, what is left out is 0, and what breaks a rule is refused by field",
          "[scene][medium]") {
  using Catch::Contains;
  const auto parse = [](const char* text) { return host::parseAmbient(nlohmann::json::parse(text), "sky"); };
  const auto refusalOf = [&](const char* text) {
    try {
      parse(text);
    } catch (const host::Error& error) {
      return std::string(error.what());
    }
    return std::string("no refusal");
  };
  const tyndall::Ambient ambient = parse(R"({"radiance": [1, 0.5, 0], "harmonics": [[1, 2, 3], [-4, 0, 0.5]]})");
  CHECK(ambient.radiance == tyndall::Rgb{1, 0.5F, 0});
  CHECK(ambient.harmonics[0] == tyndall::Rgb{1, 2, 3});
  CHECK(ambient.harmonics[1] == tyndall::Rgb{-4, 0, 0.5F});
  CHECK(ambient.harmonics[8] == tyndall::Rgb{0, 0, 0});
  CHECK(parse("{}").radiance == tyndall::Rgb{0, 0, 0});
  CHECK_THAT(refusalOf("[]"), Contains("sky: must be an object"));
  CHECK_THAT(refusalOf(R"({"colour": [1, 1, 1]})"), Contains("sky: unknown key \"colour\""));
  CHECK_THAT(refusalOf(R"({"radiance": [1, 1, -1]})"), Contains("sky.radiance[2]: -1 must be finite and not negative"));
  CHECK_THAT(refusalOf(R"({"radiance": 1})"), Contains("sky.radiance: must be 3 numbers"));
  CHECK_THAT(refusalOf(R"({"harmonics": {}})"), Contains("sky.harmonics: must be an array of at most 9"));
  CHECK_THAT(refusalOf(R"({"harmonics": [[0,0,0],0,0,0,0,0,0,0,0,0]})"), Contains("at most 9"));
  CHECK_THAT(refusalOf(R"({"harmonics": [[0, 1e39, 0]]})"), Contains("sky.harmonics[0][1]"));
  CHECK_THAT(refusalOf(R"({"harmonics": [[0, "x", 0]]})"), Contains("sky.harmonics[0][1]: must be a number"));
}

TEST_CASE("A medium says whether it dims what is behind it", "[scene][medium]") {
  nlohmann::json json = good();
  CHECK(host::parseMedium(json, "fog").dimsBackground);
  json["dimsBackground"] = false;
  CHECK_FALSE(host::parseMedium(json, "fog").dimsBackground);
  CHECK_THAT(refusal("/dimsBackground", 1), Catch::Contains("fog.dimsBackground: must be true or false"));
}

TEST_CASE("Layers of a medium, and who follows them, are read or refused by field", "[scene][medium]") {
  using Catch::Contains;
  const auto layered = [] {
    nlohmann::json json = good();
    json["layers"] = nlohmann::json::parse(R"([{"height": 2, "scale": 30, "ground": -1}, {}])");
    json["up"] = {0, 0, 2};
    json["constituents"][1]["layer"] = 1;
    json["absorptionLayer"] = 0;
    return json;
  };
  const tyndall::Medium medium = host::parseMedium(layered(), "fog");
  REQUIRE(medium.layers.size() == 2);
  CHECK(medium.layers[0].height == 2);
  CHECK(medium.layers[0].scale == 30);
  CHECK(medium.layers[0].ground == -1);
  CHECK(medium.layers[1].scale == tyndall::kInfinity);
  CHECK(medium.layers[1].ground == -tyndall::kInfinity);
  CHECK(medium.up == tyndall::Vec3{0, 0, 2});
  CHECK(medium.constituents[0].layer == -1);
  CHECK(medium.constituents[1].layer == 1);
  CHECK(medium.absorptionLayer == 0);
  const auto refused = [&](const std::string& path, const nlohmann::json& value) {
    nlohmann::json json = layered();
    json[nlohmann::json::json_pointer(path)] = value;
    return refusal(json);
  };
  CHECK_THAT(refused("/layers/2", nlohmann::json::object()), Contains("fog.layers: must be an array of at most 2"));
  CHECK_THAT(refused("/layers", 1), Contains("fog.layers: must be an array"));
  CHECK_THAT(refused("/layers/0/width", 1), Contains("fog.layers[0]: unknown key \"width\""));
  CHECK_THAT(refused("/layers/0/scale", 0), Contains("fog.layers[0].scale: 0 must be greater than 0"));
  CHECK_THAT(refused("/layers/0/scale", NAN), Contains("fog.layers[0].scale: null must be a finite number"));
  CHECK_THAT(refused("/layers/0/height", "low"), Contains("fog.layers[0].height: \"low\" must be a finite number"));
  CHECK_THAT(refused("/layers/0/ground", INFINITY), Contains("fog.layers[0].ground"));
  CHECK_THAT(refused("/up", {0, 0, 0}), Contains("fog.up: must not be 0"));
  CHECK_THAT(refused("/up", {1, 0}), Contains("fog.up: must be 3 numbers"));
  CHECK_THAT(refused("/constituents/1/layer", 2), Contains("fog.constituents[1].layer: 2 must be the index"));
  CHECK_THAT(refused("/constituents/1/layer", -1), Contains("fog.constituents[1].layer"));
  CHECK_THAT(refused("/absorptionLayer", 0.5), Contains("fog.absorptionLayer: 0.5 must be the index"));
}

TEST_CASE("A medium file is read, or refused by name", "[scene][medium]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto write = [&](const std::string& text) { writeBytes(folder / "m.json", {text.begin(), text.end()}); };
  write(good().dump());
  CHECK(host::loadMedium(folder / "m.json").constituents.size() == 4);
  write("{\"constituents\": [");
  CHECK_THAT(fileRefusal(folder / "m.json"), Contains("m.json: is not JSON"));
  write("{\"absorption\": [0, 1e999, 0]}");
  CHECK_THAT(fileRefusal(folder / "m.json"), Contains("m.json"));
  write("{\"absorption\": [0, -1, 0]}");
  CHECK_THAT(fileRefusal(folder / "m.json"), Contains("m.json: medium.absorption[1]"));
  write("");
  CHECK_THAT(fileRefusal(folder / "m.json"), Contains("m.json"));
  write("{\"farDistance\": " + std::string(400000, '[') + std::string(400000, ']') + "}"); // a message shows values
  CHECK_THAT(fileRefusal(folder / "m.json"), Contains("m.json: is not JSON: nested deeper than 64 levels"));
  CHECK_THAT(fileRefusal(folder / "none.json"), Contains("none.json: cannot be read: no such file"));
  CHECK_THAT(fileRefusal(folder.path()), Contains("not a regular file"));
}

} // namespace tests
