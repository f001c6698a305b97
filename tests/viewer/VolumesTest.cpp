// Smoke, fog and strands in the viewer: their shadows, what lights them, and what of them is a person's to set.
#include "ViewerRig.h"

#include <algorithm>
#include <gl/ReadBack.h>

TEST_CASE("smoke's density and the width of strands are a person's to set", "[pictures]") {
  for (const char* name : {"censer", "hair"}) {
    tests::ViewerRig rig;
    rig.load(name);
    CHECK(rig.viewer.hasVolumes());
    const auto picture = [&] {
      rig.settle();
      CHECK(rig.error().empty());
      return host::readColour(rig.viewer.first().composite(), 96, 54);
    };
    const std::vector<float> before = picture();
    settings::State state = rig.viewer.state();
    state.smokeDensity = 3;
    state.strandWidth = 4;
    rig.viewer.edit("volumes", state);
    CHECK(picture() != before);
    rig.viewer.undo();
    CHECK(picture() == before);
  }
}

TEST_CASE("what fog scatters, and what each bank of it holds, is a person's to set", "[pictures]") {
  tests::ViewerRig rig;
  rig.load("harbour");
  const auto picture = [&] {
    rig.settle();
    CHECK(rig.error().empty());
    return host::readColour(rig.viewer.first().composite(), 96, 54);
  };
  settings::State start = rig.viewer.state();
  start.profile = tyndall::Profile::Performance;
  start.settings = tyndall::settingsOf(start.profile);
  start.settings.slices = start.settings.samples = 64;
  start.shadowSize = 128;
  start.avsmSize = 16;
  rig.viewer.edit("less", start);
  const std::vector<float> before = picture();
  const settings::StateFog ofScene = rig.viewer.fogOf(start);
  REQUIRE(ofScene.banks.size() > 1);
  const auto edited = [&](const char* what, const auto& change) {
    CAPTURE(what);
    settings::State state = start;
    state.fog = ofScene;
    change(*state.fog);
    rig.viewer.edit(what, state);
    const std::vector<float> now = picture();
    CHECK(now != before);
    return now;
  };
  edited("fog.albedo", [](settings::StateFog& fog) { fog.scattering.albedo = {0.2F, 0.5F, 0.9F}; });
  edited("fog.g", [](settings::StateFog& fog) { fog.scattering.g = 0; });
  const auto thicker = edited("fog.banks[0].extinction", [](settings::StateFog& fog) { fog.banks[0].extinction *= 3; });
  edited("fog.banks[0].fade", [](settings::StateFog& fog) { fog.banks[0].fade = 0; });
  edited("fog.banks[1].seed", [](settings::StateFog& fog) { fog.banks[1].seed += 1; });
  edited("fog.banks[1].clear", [](settings::StateFog& fog) { fog.banks[1].clear = 0; });
  // Banks that are not listed are the scene's.
  CHECK(edited("fog.banks", [](settings::StateFog& fog) {
          fog.banks[0].extinction *= 3;
          fog.banks.resize(1);
        }) == thicker);
  rig.viewer.edit("reset fog", start);
  CHECK(picture() == before);
}

TEST_CASE("the effect lights smoke of a scene that says what it scatters, unless a person has it drawn", "[pictures]") {
  tests::ViewerRig rig;
  rig.load("smoke");
  CHECK_FALSE(rig.viewer.lightsFog());
  rig.load("censer");
  CHECK(rig.viewer.lightsFog());
  settings::State first = rig.viewer.state();
  first.litSmoke = false;
  rig.viewer.edit("volumes.litSmoke", first); // with curves of fewer nodes
  const auto picture = [&] {
    rig.settle();
    CHECK(rig.error().empty());
    return host::readColour(rig.viewer.first().composite(), 96, 54);
  };
  const std::vector<float> drawn = picture();
  CHECK_FALSE(rig.viewer.lightsFog());
  settings::State state = rig.viewer.state();
  state.litSmoke = true;
  rig.viewer.edit("volumes.litSmoke", state);
  const std::vector<float> lit = picture();
  CHECK(lit != drawn);
  state.fog = rig.viewer.fogOf(state);
  state.fog->scattering.albedo = {0, 0, 0};
  rig.viewer.edit("fog.albedo", state);
  const std::vector<float> black = picture();
  for (std::size_t i = 0; i < lit.size(); ++i)
    if (!(black[i] <= lit[i] + 1e-3F * std::abs(lit[i]))) FAIL_CHECK(i << ": " << black[i] << " of " << lit[i]);
  CHECK(black != lit);
  state = rig.viewer.state();
  state.litSmoke = false;
  rig.viewer.edit("volumes.litSmoke", state);
  CHECK(picture() == drawn);
  tests::ViewerRig fresh;
  fresh.load("censer");
  fresh.settle();
  CHECK(host::readColour(fresh.viewer.first().composite(), 96, 54) == lit);
  state.litSmoke = true;
  state.fog.reset();
  rig.viewer.edit("reset", state);
  CHECK(picture() == lit);
}

TEST_CASE("smoke's shadows outlive another size of the shadow maps", "[pictures]") {
  tests::ViewerRig rig;
  rig.load("censer");
  const auto beFast = [&] { // as a GPU is: what moves is drawn at full quality
    for (int i = 0; i < 100; ++i)
      rig.viewer.quality.drew(1);
    REQUIRE(rig.viewer.quality.level() == 0);
  };
  beFast();
  rig.settle();
  beFast();
  const auto hasCurves = [&] {
    const std::vector<tyndall::Light>& lights = rig.viewer.first().frame().lights;
    return std::all_of(lights.begin(), lights.end(), [](const auto& light) { return light.curves.texture != 0; });
  };
  CHECK(hasCurves());
  settings::State state = rig.viewer.state();
  state.shadowSize = 128;
  rig.viewer.edit("size", state);
  rig.settle();
  CHECK(hasCurves());
}

TEST_CASE("smoke's shadows follow their settings") {
  tests::ViewerRig rig;
  rig.load("smoke");
  rig.settle();
  const auto inscatter = [&] {
    rig.settle();
    CHECK(rig.error().empty());
    return host::readColour(rig.viewer.first().inscatter(), 96, 54);
  };
  const std::vector<float> with = inscatter();
  settings::State state = rig.viewer.state();
  state.avsm = false;
  rig.viewer.edit("avsm", state);
  CHECK(inscatter() != with);
  state.avsm = true;
  rig.viewer.edit("avsm again", state);
  CHECK(inscatter() == with);
}
