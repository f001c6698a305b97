// How a frame's samples are dealt out among its lights (SampleBudget.h).
#include "SampleBudget.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace {

// Looks along -z from the origin, 90 degrees high and wide.
Frame frameWith(const std::vector<Light>& lights, int budget) {
  Frame frame;
  frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002, -1, 0, 0, -0.2002, 0};
  frame.lights = lights;
  frame.medium.constituents = {{{0.02F, 0.02F, 0.02F}}};
  frame.settings.slices = 1024;
  frame.settings.samples = 512;
  frame.settings.sampleBudget = budget;
  return frame;
}

Light lamp(const Vec3& position, double range, float intensity) {
  Light light;
  light.kind = LightKind::Point;
  light.position = position;
  light.range = range;
  light.colour = {intensity, intensity, intensity};
  return light;
}

std::vector<int> dealt(const Frame& frame, std::vector<bool> drawn = {}) {
  if (drawn.empty()) drawn.assign(frame.lights.size(), true);
  std::vector<int> samples;
  for (const Settings& settings : dealSamples(frame, drawn)) {
    CHECK(settings.samples % 64 == 0);
    CHECK(settings.slices <= frame.settings.slices);
    CHECK(settings.samples <= frame.settings.samples);
    samples.push_back(settings.slices * settings.samples);
  }
  return samples;
}

constexpr int kAll = 1024 * 512;

} // namespace

TEST_CASE("without a budget, or with more than is wanted, each light has its own samples") {
  const std::vector<Light> two = {lamp({0, 0, -5}, 2, 1), lamp({1, 0, -9}, 1, 100)};
  CHECK(dealt(frameWith(two, 0)) == std::vector<int>{kAll, kAll});
  CHECK(dealt(frameWith(two, 2 * kAll)) == std::vector<int>{kAll, kAll});
}

TEST_CASE("a budget is kept, and spent") {
  std::vector<Light> lights;
  for (int i = 0; i < 7; ++i)
    lights.push_back(lamp({0.7 * i - 2, 0, -6.0 - i}, 1 + i % 3, 1.0F + static_cast<float>(i)));
  for (const int budget : {7 * 4096, 100000, 500000, 2000000}) {
    int sum = 0;
    for (const int samples : dealt(frameWith(lights, budget)))
      sum += samples;
    CAPTURE(budget, sum);
    CHECK(sum <= budget);
    CHECK(sum >= budget / 2); // samples come in whole 64s
  }
}

TEST_CASE("a budget is kept though one light is cut to the most and the others are raised to the least") {
  std::vector<Light> lights(16, lamp({0, 0, -6}, 1, 0.002F));
  lights[0].colour = {1, 1, 1};
  Frame frame = frameWith(lights, 120000);
  frame.settings.slices = 576;
  frame.settings.samples = 192;
  int sum = 0;
  for (const int samples : dealt(frame))
    sum += samples;
  CHECK(sum <= 120000);
}

TEST_CASE("techniques without samples have no budget") {
  Frame frame = frameWith({lamp({0, 0, -6}, 1, 1)}, 4096);
  frame.settings.technique = Technique::Tree;
  CHECK(dealt(frame) == std::vector<int>{kAll});
}

TEST_CASE("what covers more of the image, or is brighter, gets more samples; the same light the same") {
  const Light light = lamp({0, 0, -6}, 4, 4);
  for (const Light& lesser : {lamp({0, 0, -6}, 1.5, 4), lamp({0, 0, -6}, 4, 1)}) {
    const std::vector<int> samples = dealt(frameWith({light, lesser, light}, 400000));
    CHECK(samples[0] > samples[1]);
    CHECK(samples[0] == samples[2]);
  }
}

TEST_CASE("lights that are not drawn leave their samples to the others") {
  const Light light = lamp({0, 0, -6}, 1, 4);
  const std::vector<int> three = dealt(frameWith({light, light, light}, 300000));
  const std::vector<int> one = dealt(frameWith({light, light, light}, 300000), {false, true, false});
  CHECK(one[1] > 2 * three[1]);
}

TEST_CASE("each light gets the least there is, however small the budget and dim the light") {
  const Light light = lamp({0, 0, -6}, 1, 1e6F), dim = lamp({40, 0, -6}, 1, 1e-6F); // outside the image, too
  for (const int samples : dealt(frameWith({light, dim, dim}, 4096)))
    CHECK(samples == kLeastSamples);
  const std::vector<int> uneven = dealt(frameWith({light, dim}, 200000));
  CHECK(uneven[1] == kLeastSamples);
  CHECK(uneven[0] > 150000);
}
