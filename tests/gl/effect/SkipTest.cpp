// What a frame skips (DESIGN 6): the statistics say so, and the picture is the one that the work would have given.
#include "SceneRig.h"
#include "ShaftRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace tyndall;

namespace {

constexpr const char* kOutOfView = "the light's volume is outside the view";

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 8) * 0x1p-24;
}

Vec3 uniformIn(std::mt19937& random, double extent) {
  return {uniform(random, -extent, extent), uniform(random, -extent, extent), uniform(random, -extent, extent)};
}

// Why a light did not run: its own entry is the only one that bears its name alone.
std::string whySkipped(const std::string& name) {
  for (const PassStatistics& pass : tests::testEffect().statistics().passes)
    if (pass.name == name) return pass.skipped;
  return "no such pass";
}

bool isBlack(const reference::Image& image) {
  return std::all_of(image.rgb.begin(), image.rgb.end(), [](double v) { return v == 0; });
}

// A lamp somewhere around a camera; wide enough not to hide between pixels.
Light randomLamp(std::mt19937& random, LightKind kind, bool endless) {
  Light light;
  light.kind = kind;
  light.position = uniformIn(random, 8);
  light.direction = uniformIn(random, 1);
  light.colour = {3, 3, 3};
  light.outerConeAngle = uniform(random, 0.3, 1.5);
  light.innerConeAngle = light.outerConeAngle * uniform(random, 0, 1);
  if (!endless) light.range = std::exp(uniform(random, 0, 2));
  return light;
}

std::vector<tests::DepthConvention> cameras() {
  std::vector<tests::DepthConvention> all(4);
  all[1].reversed = all[1].infinite = true;
  all[1].clipDepth = ClipDepth::ZeroToOne;
  all[2].orthographic = true;
  all[3].orthographic = all[3].reversed = true;
  return all;
}

struct Count {
  int skipped = 0, dark = 0;
};

void countLamp(tests::SceneRig& rig, const Light& lamp, Count& count) {
  rig.frame.lights = {lamp};
  rig.render();
  const bool skipped = whySkipped("exact light 0") == kOutOfView, dark = isBlack(rig.reference().inscatter);
  CAPTURE(lamp.position[0], lamp.position[1], lamp.position[2], lamp.range, lamp.outerConeAngle);
  CHECK((dark || !skipped));
  count.skipped += skipped;
  count.dark += dark;
}

const std::vector<Technique> kTechniques = {Technique::Exact, Technique::Tree, Technique::Epipolar};

std::string lightName(Technique technique, int index) {
  return (technique == Technique::Exact ? "exact light " : "light ") + std::to_string(index);
}

bool anyRan() {
  const Statistics statistics = tests::testEffect().statistics();
  return std::any_of(statistics.passes.begin(), statistics.passes.end(),
                     [](const PassStatistics& pass) { return pass.skipped.empty(); });
}

std::vector<float> colours(const Frame& frame) {
  std::mt19937 random(3);
  std::vector<float> values;
  for (int i = 0; i < 4 * frame.viewport.width * frame.viewport.height; ++i)
    values.push_back(static_cast<float>(uniform(random, 0, 2)));
  return values;
}

// A sun with a shadow map and a lamp with one, both seen.
tests::ShaftRig sunAndLamp() {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  rig.addLight(tests::shaftLight(LightKind::Spot), 64);
  return rig;
}

// The picture with the rig's lights but one; its statistics stay the last frame's.
reference::Image without(tests::ShaftRig& rig, std::size_t light, Technique technique) {
  const std::vector<Light> lights = rig.scene.frame.lights;
  rig.scene.frame.lights.erase(rig.scene.frame.lights.begin() + static_cast<std::ptrdiff_t>(light));
  const reference::Image picture = rig.picture(technique);
  rig.scene.frame.lights = lights;
  return picture;
}

// The second light must be skipped for that reason, and the picture be the first one's.
void checkSkipped(tests::ShaftRig& rig, const std::string& reason) {
  for (const Technique technique : kTechniques) {
    CAPTURE(static_cast<int>(technique), reason);
    const reference::Image expected = without(rig, 1, technique), picture = rig.picture(technique);
    CHECK(whySkipped(lightName(technique, 1)) == reason);
    CHECK(picture == expected);
    CHECK_FALSE(isBlack(picture));
  }
}

} // namespace

TEST_CASE("a light whose volume no ray meets is skipped, and none that a ray meets", "[slow]") {
  std::mt19937 random(5);
  for (const tests::DepthConvention& camera : cameras()) {
    tests::SceneRig rig(24, 16);
    rig.distances.assign(rig.distances.size(), kInfinity); // what does not show is then outside the view
    rig.setConvention(camera);
    rig.addLight(LightKind::Point, tests::Casters::None);
    for (const LightKind kind : {LightKind::Point, LightKind::Spot})
      for (const bool endless : {false, true}) {
        if (endless && kind == LightKind::Point) continue;
        Count count;
        for (int i = 0; i < 150; ++i)
          countLamp(rig, randomLamp(random, kind, endless), count);
        CAPTURE(camera.orthographic, camera.reversed, static_cast<int>(kind), endless, count.dark, count.skipped);
        CHECK(count.dark >= 20);
        CHECK(count.skipped >= 0.75 * count.dark);
      }
  }
}

TEST_CASE("with every technique a light outside the view costs nothing and changes nothing") {
  tests::ShaftRig rig = sunAndLamp();
  Light& lamp = rig.scene.frame.lights[1];
  lamp.position = {0, 2, 7}; // behind the eye, shining away from it
  lamp.direction = {0.2, 0.1, 1};
  lamp.shadow.views = tests::shadowViews(lamp);
  checkSkipped(rig, kOutOfView);
  lamp.direction = {0, 0, -1}; // at it, but not so far
  lamp.shadow.views = tests::shadowViews(lamp);
  lamp.range = 6.9;
  checkSkipped(rig, kOutOfView);
  lamp.kind = LightKind::Point;
  lamp.shadow = {};
  checkSkipped(rig, kOutOfView);
  lamp.range = 7.1;
  for (const Technique technique : kTechniques) {
    rig.picture(technique);
    CHECK(whySkipped(lightName(technique, 1)) != kOutOfView);
  }
}

TEST_CASE("with every technique a black light costs nothing and changes nothing") {
  tests::ShaftRig rig = sunAndLamp();
  rig.scene.frame.lights[1].colour = {0, 0, 0};
  checkSkipped(rig, "the light is black");
}

TEST_CASE("a medium that only absorbs is drawn without its lights") {
  tests::ShaftRig rig = sunAndLamp();
  Medium& medium = rig.scene.frame.medium;
  medium.constituents[0].scattering = {0, 0, 0};
  medium.absorption = {0.1F, 0.1F, 0.1F};
  for (const Technique technique : kTechniques) {
    CAPTURE(static_cast<int>(technique));
    rig.scene.frame.settings.technique = technique;
    const reference::ImageAnswer answer = rig.scene.render(), expected = rig.scene.reference();
    CHECK(whySkipped(lightName(technique, 0)) == "the medium does not scatter");
    CHECK(whySkipped(lightName(technique, 1)) == "the medium does not scatter");
    CHECK(whySkipped("transmittance").empty());
    CHECK(isBlack(answer.inscatter));
    CHECK(tests::difference(answer.transmittance, expected.transmittance) <= 1e-6);
  }
}

TEST_CASE("without a medium nothing runs, and without lights only the transmittance") {
  tests::ShaftRig rig = sunAndLamp();
  Frame& frame = rig.scene.frame;
  const Medium medium = frame.medium;
  const Output output = frame.output;
  frame.output = {};
  for (const Technique technique : kTechniques) {
    CAPTURE(static_cast<int>(technique));
    const std::vector<float> before = colours(frame);
    const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, before);
    frame.settings.technique = technique;
    frame.medium.constituents.clear();
    REQUIRE(tests::testEffect().render(frame));
    CHECK_FALSE(anyRan());
    CHECK(whySkipped("composite") == "the medium neither scatters nor absorbs");
    CHECK(tests::bitEqual(host::readColour(colour.name(), frame.viewport.width, frame.viewport.height, 4), before));

    frame.medium = medium;
    Frame dark = frame;
    dark.lights.clear();
    REQUIRE(tests::testEffect().render(dark));
    const Statistics statistics = tests::testEffect().statistics();
    CHECK(statistics.passes.size() == 1);
    CHECK(statistics.passes[0].name == "transmittance");
  }
  frame.output = output;
}

TEST_CASE("a scalar path serves a medium without colour") {
  for (const Technique technique : kTechniques) {
    CAPTURE(static_cast<int>(technique));
    tests::ShaftRig rig(48, 32);
    rig.addLight(tests::shaftLight(LightKind::Directional), 64).colour = {5, 4, 3};
    rig.scene.frame.settings.technique = technique;
    const std::unique_ptr<Effect> created = tests::newEffect();
    Effect& effect = *created;
    const reference::Image grey = rig.scene.render(effect).inscatter;
    const Statistics before = effect.statistics();
    rig.scene.frame.medium.absorption[2] = 1e-9F;
    const reference::Image coloured = rig.scene.render(effect).inscatter;
    const Statistics after = effect.statistics();
    CHECK(after.compiledPrograms > before.compiledPrograms);
    if (technique == Technique::Epipolar) CHECK(after.bytes > before.bytes);
    // Epipolar keeps colours in half floats.
    CHECK(tests::difference(grey, coloured) <= (technique == Technique::Epipolar ? 2e-3 : 1e-6));
  }
}

TEST_CASE("no colour path without glass, and clear glass changes nothing") {
  for (const Technique technique : kTechniques) {
    CAPTURE(static_cast<int>(technique));
    tests::ShaftRig rig(48, 32);
    rig.addLight(tests::shaftLight(LightKind::Directional), 64, true);
    rig.scene.frame.settings.technique = technique;
    reference::ShadowImage clear = rig.scene.shadow(0);
    clear.glassColour.assign(clear.glassColour.size(), 1.0F);
    rig.scene.setShadow(0, clear);
    const GlassMap glass = rig.scene.frame.lights[0].glass;
    rig.scene.frame.lights[0].glass = {};
    const std::unique_ptr<Effect> created = tests::newEffect();
    Effect& effect = *created;
    const reference::Image plain = rig.scene.render(effect).inscatter;
    const Statistics before = effect.statistics();
    rig.scene.frame.lights[0].glass = glass;
    const reference::Image through = rig.scene.render(effect).inscatter;
    const Statistics after = effect.statistics();
    CHECK(after.compiledPrograms > before.compiledPrograms);
    if (technique == Technique::Epipolar) CHECK(after.bytes > before.bytes);
    CHECK(tests::difference(plain, through) <= (technique == Technique::Epipolar ? 5e-3 : 1e-4));
  }
}

TEST_CASE("a lamp or sun without a shadow map has no rows") {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    rig.scene.frame.lights[0].shadow.texture = 0;
    rig.changed();
    const reference::Image picture = rig.picture(technique);
    CHECK(whySkipped("light 0 rows") == "no such pass");
    CHECK(rig.error(picture).rRmse <= 0.02);
  }
}

TEST_CASE("fix-up marches no pixel where every one is served") {
  tests::ShaftRig rig(48, 32);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  rig.scene.distances.assign(rig.scene.distances.size(), 20); // one plane: no break
  rig.scene.setConvention(rig.scene.convention());
  const reference::Image picture = rig.picture(Technique::Epipolar);
  CHECK(tests::testEffect().statistics().fixupPixels == 0);
  rig.scene.frame.settings.leastWeight = 1; // what fix-up makes of those pixels
  const reference::Image fixed = rig.picture(Technique::Epipolar);
  const std::uint64_t pixels = tests::testEffect().statistics().fixupPixels;
  CHECK(pixels > 0);
  CHECK(tests::errorWhere(picture, fixed, [](int, int) { return true; }) <= 0.01);
}
