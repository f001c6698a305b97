// States as files: what is written is read back, and what breaks a rule is refused as a whole.
#include "RandomState.h"
#include "support/Catch.h"
#include "support/TemporaryFolder.h"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <set>
#include <settings/StateFile.h>
#include <settings/Tables.h>

namespace {

namespace fs = std::filesystem;

std::string refusalOf(const std::string& text) {
  try {
    settings::parseState(text, "a.json", "/folder");
  } catch (const host::Error& error) {
    return error.what();
  }
  return "none";
}

} // namespace

TEST_CASE("a state is read back as it was, whatever it is") {
  const fs::path folder = fs::current_path();
  for (unsigned seed = 0; seed < 500; ++seed) {
    settings::State state = tests::randomState(seed);
    state.scene = folder / state.scene;
    const std::string text = settings::textOf(state, folder);
    const settings::State back = settings::parseState(text, "a.json", folder);
    CAPTURE(seed, text);
    CHECK(tests::differences(state, back) == std::vector<std::string>());
    CHECK(settings::textOf(back, folder) == text);
  }
}

TEST_CASE("random states reach every setting") {
  std::set<std::string> reached;
  const settings::State start;
  for (unsigned seed = 0; seed < 200; ++seed)
    for (const std::string& field : tests::differences(start, tests::randomState(seed)))
      reached.insert(field);
  settings::visitTables(start, [&](const std::string& name, const auto&, const auto& table) {
    for (const auto& row : table.rows) {
      CAPTURE(name, row.field);
      CHECK(reached.count(name + "." + row.field) == 1);
    }
  });
}

TEST_CASE("a state's scene is found from the state's folder") {
  const tests::TemporaryFolder folder;
  fs::create_directories(folder / "scenes");
  settings::State state;
  state.scene = folder / "scenes/nave.glb";
  settings::saveState(folder / "a.json", state);
  CHECK(settings::loadState(folder / "a.json").scene == folder / "scenes/nave.glb");
  fs::create_directories(folder / "moved");
  fs::rename(folder / "a.json", folder / "moved/a.json");
  CHECK(settings::loadState(folder / "moved/a.json").scene == folder / "moved/scenes/nave.glb");
}

TEST_CASE("what a state leaves out is at its default, settings at the profile's") {
  const settings::State empty = settings::parseState(R"({"version": 1})", "a.json", "/");
  CHECK(tests::differences(empty, settings::State()) == std::vector<std::string>());
  const settings::State fast =
      settings::parseState(R"({"profile": "performance", "settings": {"slices": 77}, "version": 1})", "a.json", "/");
  CHECK(fast.settings.slices == 77);
  CHECK(fast.settings.samples == tyndall::settingsOf(tyndall::Profile::Performance).samples);
}

TEST_CASE("a state that breaks a rule is refused with field, value and rule") {
  const std::pair<const char*, const char*> cases[] = {
      {"", "a.json: is not JSON: "},
      {R"({"version": 1)", "a.json: is not JSON: "},
      {"[]", "a.json: must be an object"},
      {"{}", "a.json: version is missing: this is no state of the viewer's"},
      {R"({"version": 2})", "a.json: version: 2 must be 1"},
      {R"({"version": "1"})", "a.json: version: \"1\" must be 1"},
      {R"({"version": 1, "colour": 3})", "a.json: has no field \"colour\""},
      {R"({"version": 1, "scene": 3})", "a.json: scene: must be the name of a file"},
      {R"({"version": 1, "camera": {"scene": -1}})",
       "a.json: camera.scene: -1 must be a whole number from 0 to 999999"},
      {R"({"version": 1, "camera": {"scene": 1, "eye": [0, 0, 1]}})", "no other field may stand there"},
      {R"({"version": 1, "camera": {"eye": [1, 2, 3], "target": [1, 2, 3]}})",
       "camera.target: must differ from camera.eye"},
      {R"({"version": 1, "camera": {"eye": [1, 2]}})", "a.json: camera.eye: [1,2] must be three finite numbers"},
      {R"({"version": 1, "camera": {"fovDegrees": 180}})",
       "a.json: camera.fovDegrees: 180 must be a number between 0 and 180"},
      {R"({"version": 1, "profile": "fast"})",
       "a.json: profile: \"fast\" must be one of performance, balanced, high, reference"},
      {R"({"version": 1, "settings": []})", "a.json: settings: must be an object"},
      {R"({"version": 1, "settings": {"slices": 0}})",
       "a.json: settings.slices: 0 must be a whole number from 1 to 8192"},
      {R"({"version": 1, "settings": {"slices": 1.5}})", "a.json: settings.slices: 1.5 must be a whole number"},
      {R"({"version": 1, "settings": {"slices": null}})", "a.json: settings.slices: null must be"},
      {R"({"version": 1, "settings": {"slizes": 1}})", "a.json: settings: has no field \"slizes\""},
      {R"({"version": 1, "settings": {"minMaxTree": 1}})", "a.json: settings.minMaxTree: 1 must be true or false"},
      {R"({"version": 1, "settings": {"technique": 0}})",
       "a.json: settings.technique: 0 must be one of exact, tree, epipolar, lowrank"},
      {R"({"version": 1, "settings": {"breakThreshold": 1e999}})", "a.json: "},
      {R"({"version": 1, "settings": {"breakThreshold": "infinity"}})",
       "a.json: settings.breakThreshold: \"infinity\" must be"},
      {R"({"version": 1, "maps": {"cascades": 5}})", "a.json: maps.cascades: 5 must be a whole number from 1 to 4"},
      {R"({"version": 1, "picture": {"width": 16384, "supersample": 2}})",
       "a.json: picture.supersample: 2 makes more than 16384 pixels a side"},
      {R"({"version": 1, "medium": {"constituents": [{}, {"g": 1}]}})",
       "a.json: medium.constituents[1].g: 1 must be a number between -1 and 1"},
      {R"({"version": 1, "medium": {"constituents": [{}, {}, {}, {}, {}]}})",
       "a.json: medium.constituents: must be a list of at most 4"},
      {R"({"version": 1, "fog": {"albedo": [0.5, 1.5, 0.5]}})",
       "a.json: fog.albedo: [0.5,1.5,0.5] must be three finite numbers from 0 to 1"},
      {R"({"version": 1, "fog": {"banks": [{}, {"fade": 2}]}})",
       "a.json: fog.banks[1].fade: 2 must be a number from 0"},
      {R"({"version": 1, "fog": {"banks": [{"extinction": 1e16}]}})",
       "a.json: fog.banks[0].extinction: 1e+16 must be a number from 0 to 1000000000000000"},
      {R"({"version": 1, "fog": {"banks": [{"billows": [1, 1, 1]}]}})",
       "a.json: fog.banks[0]: has no field \"billows\""},
      {R"({"version": 1, "fog": {"banks": [{}, {}, {}, {}, {}, {}, {}, {}, {}]}})",
       "a.json: fog.banks: must be a list of at most 8"},
      {R"({"version": 1, "lights": {}})", "a.json: lights: must be a list of at most 16"},
      {R"({"version": 1, "lights": [{"colour": [1, -1, 1]}]})",
       "a.json: lights[0].colour: [1,-1,1] must be three finite numbers, none negative"},
      {R"({"version": 1, "lights": [{"direction": [0, 0, 0]}]})",
       "a.json: lights[0].direction: [0,0,0] must be three finite numbers, not all 0"},
      {R"({"version": 1, "lights": [{"boundary": {"normal": 3}}]})", "a.json: lights[0].boundary.normal: 3 must be"},
      {R"({"version": 1, "lights": [{"boundary": {"plane": 3}}]})",
       "a.json: lights[0].boundary: has no field \"plane\""},
      {R"({"version": 1, "lights": [{"innerConeAngle": 1, "outerConeAngle": 0.5}]})",
       "a.json: lights[0].innerConeAngle: 1 must not exceed outerConeAngle, 0.5"},
      {R"({"version": 1, "compared": {"profile": "fast"}})", "a.json: compared.profile: \"fast\" must be one of"},
      {R"({"version": 1, "compared": {"settings": {"slices": 0}}})", "a.json: compared.settings.slices: 0 must be"},
      {R"({"version": 1, "compared": {"wipe": 1}})", "a.json: compared: has no field \"wipe\""},
      {R"({"version": 1, "path": [{"eye": [0, 0, 0], "target": [0, 0, 0]}]})",
       "a.json: path[0].target: must differ from its eye"},
      {R"({"version": 1, "path": [{"seconds": 2}, {"seconds": 1}]})",
       "a.json: path[1].seconds: 1 must not be before the point before it"},
      {R"({"version": 1, "path": [{"seconds": -1}]})", "a.json: path[0].seconds: -1 must be a number from 0"},
  };
  for (const auto& [text, message] : cases) {
    CAPTURE(text);
    CHECK_THAT(refusalOf(text), Catch::Contains(message));
    CHECK(refusalOf(text).find('\n') == std::string::npos);
  }
}

TEST_CASE("a state of endless brackets is refused, without a message that takes the stack") {
  const std::string brackets = std::string(400000, '[') + std::string(400000, ']');
  const std::string refusal = refusalOf(R"({"version": 1, "camera": {"scene": )" + brackets + "}}");
  CHECK(refusal == "a.json: is not JSON: nested deeper than 64 levels");
}

TEST_CASE("every setting out of its range is refused by its name") {
  const auto check = [](const std::string& name, const auto& table) {
    for (const auto& row : table.rows) {
      if (row.field.find('.') != std::string::npos) continue;
      for (const char* bad : {"\"nonsense\"", "-1e30", "[true]", "{}"}) {
        const std::string refusal =
            refusalOf(R"({"version": 1, ")" + name + R"(": {")" + row.field + "\": " + bad + "}}");
        CAPTURE(name, row.field, bad);
        CHECK_THAT(refusal, Catch::Contains("a.json: " + name + "." + row.field + ": "));
      }
    }
  };
  const settings::State start;
  settings::visitTables(start, [&](const char* name, const auto&, const auto& table) { check(name, table); });
}

TEST_CASE("a state that cannot be written leaves what there was") {
  const tests::TemporaryFolder folder;
  fs::create_directories(folder / "scenes");
  const fs::path file = folder / "a.json";
  settings::State state;
  settings::saveState(file, state);
  state.settings.slices = 5;
  CHECK_THROWS_AS(settings::saveState(folder / "missing/a.json", state), host::Error);
  fs::create_directories(folder / "b.json");
  CHECK_THROWS_AS(settings::saveState(folder / "b.json", state), host::Error);
  CHECK(settings::loadState(file).settings.slices == settings::State().settings.slices);
  settings::saveState(file, state);
  CHECK(settings::loadState(file).settings.slices == 5);
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 3); // nothing unfinished
}
