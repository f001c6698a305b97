// What becomes of the colour: composited, output, or both; formats; several lights; what is skipped and said so.
#include "SceneRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

using namespace tyndall;

namespace {

constexpr int kWidth = 24, kHeight = 16;

// A colour per pixel, alpha too, that half floats and 11-bit floats hold exactly.
std::vector<float> backBuffer() {
  std::vector<float> rgba;
  for (int i = 0; i < kWidth * kHeight; ++i)
    rgba.insert(rgba.end(), {0.25F * static_cast<float>(1 + i % 7), 0.5F * static_cast<float>(i % 5), 4.0F,
                             0.125F * static_cast<float>(i % 9)});
  return rgba;
}

std::vector<float> readColour(const host::GlTexture& colour) {
  return host::readColour(colour.name(), kWidth, kHeight);
}

// Renders over the back buffer and returns what it became, RGBA.
std::vector<float> composite(tests::SceneRig& rig, const Output& output, GLenum format = GL_RGBA32F) {
  const host::GlTexture colour = rig.makeColour(format, backBuffer());
  Frame frame = rig.frame;
  frame.output = output;
  const Status status = tests::testEffect().render(frame);
  INFO(status.message);
  REQUIRE(status);
  rig.frame.colour = 0;
  return readColour(colour);
}

// Largest error of colour = back T + inscatter, relative to the value; alpha must be the back buffer's own.
double compositeError(const std::vector<float>& colour, const reference::ImageAnswer& light, bool hasAlpha = true) {
  const std::vector<float> back = backBuffer();
  double worst = 0;
  for (std::size_t pixel = 0; pixel < kWidth * kHeight; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected =
          back[4 * pixel + c] * light.transmittance.rgb[3 * pixel + c] + light.inscatter.rgb[3 * pixel + c];
      worst = std::max(worst, std::abs(colour[4 * pixel + c] - expected) / std::max(expected, 1e-3));
    }
    if (hasAlpha) REQUIRE(colour[4 * pixel + 3] == back[4 * pixel + 3]);
  }
  return worst;
}

tests::SceneRig threeLights() {
  tests::SceneRig rig = tests::threeLights();
  rig.frame.medium.absorption = {0.01F, 0.03F, 0.02F};
  return rig;
}

const PassStatistics* findPass(const Statistics& statistics, const std::string& name) {
  for (const PassStatistics& pass : statistics.passes)
    if (pass.name == name) return &pass;
  return nullptr;
}

std::string whySkipped(Effect& effect, const std::string& name) {
  const Statistics statistics = effect.statistics();
  const PassStatistics* pass = findPass(statistics, name);
  return pass ? pass->skipped : "no such pass";
}

} // namespace

TEST_CASE("colour becomes colour times transmittance plus inscatter, whatever is output besides") {
  tests::SceneRig rig = threeLights();
  const reference::ImageAnswer light = rig.render();
  const Output both = rig.frame.output;
  const std::vector<float> direct = composite(rig, {});
  CHECK(compositeError(direct, light) <= 1e-6);
  CHECK(compositeError(composite(rig, both), light) <= 1e-6);
  CHECK(rig.outputs().inscatter == light.inscatter);
  CHECK(rig.outputs().transmittance == light.transmittance);
  CHECK(compositeError(composite(rig, {both.inscatter, 0}), light) <= 1e-6);
  CHECK(rig.outputs().inscatter == light.inscatter);
  CHECK(compositeError(composite(rig, {0, both.transmittance}), light) <= 1e-6);
  CHECK(rig.outputs().transmittance == light.transmittance);
}

TEST_CASE("an output alone equals the two together") {
  tests::SceneRig rig = threeLights();
  const reference::ImageAnswer light = rig.render();
  const Output both = rig.frame.output;
  for (const Output& output : {Output{both.inscatter, 0}, Output{0, both.transmittance}}) {
    const std::vector<float> filling(4 * kWidth * kHeight, 77.0F);
    const host::GlTexture texture = tests::floatTexture(GL_RGBA32F, kWidth, kHeight, filling);
    Frame frame = rig.frame;
    frame.output = {output.inscatter ? texture.name() : 0, output.transmittance ? texture.name() : 0};
    const Status status = tests::testEffect().render(frame);
    INFO(status.message);
    REQUIRE(status);
    const std::vector<float> values = host::readColour(texture.name(), kWidth, kHeight, 3);
    const reference::Image& expected = output.inscatter ? light.inscatter : light.transmittance;
    CHECK(std::vector<double>(values.begin(), values.end()) == expected.rgb);
  }
}

TEST_CASE("every colour format is composited to its own precision") {
  tests::SceneRig rig;
  rig.addLight(LightKind::Directional);
  const reference::ImageAnswer light = rig.render();
  CHECK(compositeError(composite(rig, {}, GL_RGBA16F), light) <= std::pow(2.0, -10));
  CHECK(compositeError(composite(rig, {}, GL_R11F_G11F_B10F), light, false) <= std::pow(2.0, -5));
  CHECK(compositeError(composite(rig, rig.frame.output, GL_RGBA16F), light) <= std::pow(2.0, -10));
}

TEST_CASE("radiance beyond a format's largest value stays finite") {
  tests::SceneRig rig;
  Light& light = rig.addLight(LightKind::Directional, tests::Casters::None);
  light.colour = {1e9F, 3e38F, 1e6F};
  rig.addLight(LightKind::Point, tests::Casters::None).colour = {3e38F, 1e12F, 1};
  for (const GLenum format : {GL_RGBA16F, GL_R11F_G11F_B10F, GL_RGBA32F})
    for (const Output& output : {Output{}, rig.frame.output}) {
      const std::vector<float> colour = composite(rig, output, format);
      CAPTURE(format, output.inscatter);
      CHECK(std::all_of(colour.begin(), colour.end(), [](float v) { return std::isfinite(v) && v >= 0; }));
    }
}

TEST_CASE("lights add up, in any order") {
  tests::SceneRig rig = threeLights();
  const std::vector<Light> lights = rig.frame.lights;
  const reference::ImageAnswer all = rig.render();
  std::swap(rig.frame.lights[0], rig.frame.lights[2]);
  const reference::ImageAnswer permuted = rig.render();
  CHECK(tests::difference(permuted.inscatter, all.inscatter) <= 1e-6);
  CHECK(permuted.transmittance == all.transmittance);
  reference::Image sum(kWidth, kHeight);
  for (const Light& light : lights) {
    rig.frame.lights = {light};
    const reference::ImageAnswer one = rig.render();
    CHECK(one.transmittance == all.transmittance);
    std::transform(sum.rgb.begin(), sum.rgb.end(), one.inscatter.rgb.begin(), sum.rgb.begin(), std::plus<>());
  }
  CHECK(tests::difference(all.inscatter, sum) <= 1e-6);
  rig.frame.lights.assign(kMaxLights, lights[0]);
  const reference::ImageAnswer many = rig.render();
  rig.frame.lights = {lights[0]};
  reference::Image times = rig.render().inscatter;
  for (double& v : times.rgb)
    v *= kMaxLights;
  CHECK(tests::difference(many.inscatter, times) <= 2e-6);
}

TEST_CASE("a medium that neither scatters nor absorbs leaves the colour bit-equal and says so") {
  tests::SceneRig rig = threeLights();
  rig.frame.medium.absorption = {0, 0, 0};
  for (const bool constituents : {false, true}) {
    if (!constituents)
      rig.frame.medium.constituents.clear();
    else
      rig.frame.medium.constituents = {{{0, 0, 0}, Phase::Rayleigh, 0}};
    CHECK(tests::bitEqual(composite(rig, {}), backBuffer()));
    CHECK(whySkipped(tests::testEffect(), "composite") == "the medium neither scatters nor absorbs");
    CHECK(tests::testEffect().statistics().passes.size() == 1);
    CHECK(tests::bitEqual(composite(rig, rig.frame.output), backBuffer()));
    const reference::ImageAnswer light = rig.outputs();
    CHECK(light.inscatter.rgb == std::vector<double>(light.inscatter.rgb.size(), 0));
    CHECK(light.transmittance.rgb == std::vector<double>(light.transmittance.rgb.size(), 1));
  }
}

TEST_CASE("a medium that only absorbs dims the colour and skips the lights") {
  tests::SceneRig rig = threeLights();
  rig.frame.medium.constituents.clear();
  rig.frame.medium.absorption = {0.3F, 0, 0.02F};
  const reference::ImageAnswer truth = rig.reference();
  CHECK(compositeError(composite(rig, {}), truth) <= 2e-6);
  for (const char* name : {"exact light 0", "exact light 1", "exact light 2"})
    CHECK(whySkipped(tests::testEffect(), name) == "the medium does not scatter");
  CHECK(whySkipped(tests::testEffect(), "transmittance").empty());
  CHECK(compositeError(composite(rig, rig.frame.output), truth) <= 2e-6);
  const std::vector<double>& inscatter = rig.outputs().inscatter.rgb;
  CHECK(std::all_of(inscatter.begin(), inscatter.end(), [](double v) { return v == 0; }));
}

TEST_CASE("without lights the colour is dimmed") {
  tests::SceneRig rig;
  const reference::ImageAnswer truth = rig.reference();
  CHECK(compositeError(composite(rig, {}), truth) <= 2e-6);
  CHECK(compositeError(composite(rig, rig.frame.output), truth) <= 2e-6);
}

TEST_CASE("a black light is skipped, says so, and changes nothing") {
  tests::SceneRig rig = threeLights();
  for (const std::size_t black : {0U, 1U, 2U}) {
    tests::SceneRig with = threeLights();
    with.frame.lights[black].colour = {0, 0, 0};
    const reference::ImageAnswer expected = with.reference();
    const reference::ImageAnswer answer = with.render();
    CHECK(whySkipped(tests::testEffect(), "exact light " + std::to_string(black)) == "the light is black");
    CHECK(whySkipped(tests::testEffect(), "exact light " + std::to_string((black + 1) % 3)).empty());
    CHECK(tests::difference(answer.inscatter, expected.inscatter) <= 1e-5);
    Frame without = with.frame;
    without.lights.erase(without.lights.begin() + static_cast<std::ptrdiff_t>(black));
    REQUIRE(tests::testEffect().render(without));
    CHECK(with.outputs().inscatter == answer.inscatter);
  }
  for (Light& light : rig.frame.lights)
    light.colour = {0, 0, 0};
  const reference::ImageAnswer dark = rig.render();
  CHECK(dark.inscatter.rgb == std::vector<double>(dark.inscatter.rgb.size(), 0));
  CHECK(tests::difference(dark.transmittance, rig.reference().transmittance) <= 1e-6);
}

TEST_CASE("statistics name the passes and time them") {
  tests::SceneRig rig = threeLights();
  const host::GlTexture colour = rig.makeColour(GL_RGBA16F, backBuffer());
  for (const PassTiming timing : {PassTiming::Off, PassTiming::Finish, PassTiming::TimerQuery}) {
    CAPTURE(static_cast<int>(timing));
    const std::unique_ptr<Effect> result = tests::newEffect({{}, timing});
    CHECK(result->statistics().passes.empty());
    const auto begin = std::chrono::steady_clock::now();
    REQUIRE(result->render(rig.frame));
    const Statistics statistics = result->statistics();
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    std::vector<std::string> names;
    double sum = 0;
    for (const PassStatistics& pass : statistics.passes) {
      names.push_back(pass.name);
      CHECK(pass.skipped.empty());
      if (timing == PassTiming::Off)
        CHECK(pass.milliseconds == 0);
      else
        CHECK(pass.milliseconds > 0);
      sum += pass.milliseconds;
    }
    CHECK(sum <= taken.count()); // passes follow one another, and it waited for them
    CHECK(names ==
          std::vector<std::string>{"transmittance", "exact light 0", "exact light 1", "exact light 2", "composite"});
    CHECK(statistics.compiledPrograms == 5);
    CHECK(statistics.bytes > 0);
    REQUIRE(result->render(rig.frame));
    CHECK(result->statistics().passes.size() == 5); // of the last frame only
    CHECK(result->statistics().compiledPrograms == 5);
    Frame frame = rig.frame;
    frame.output.inscatter = 0;
    REQUIRE(result->render(frame));
    CHECK(result->statistics().bytes == statistics.bytes + 16 * kWidth * kHeight);
  }
}

TEST_CASE("equal coefficients in all channels draw the picture that unequal ones draw", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const bool glass : {false, true}) {
      CAPTURE(static_cast<int>(kind), glass);
      tests::SceneRig rig;
      rig.addLight(kind, tests::Casters::Blocks, glass);
      rig.frame.medium.constituents = {{{0.1F, 0.1F, 0.1F}, Phase::CornetteShanks, 0.5F}};
      rig.frame.medium.absorption = {0.02F, 0.02F, 0.02F};
      const reference::ImageAnswer grey = rig.render();
      rig.frame.medium.absorption[2] = std::nextafter(0.02F, 1.0F);
      const reference::ImageAnswer coloured = rig.render();
      CHECK(tests::difference(grey.inscatter, coloured.inscatter) <= 1e-6);
      CHECK(tests::difference(grey.transmittance, coloured.transmittance) <= 1e-6);
    }
}
