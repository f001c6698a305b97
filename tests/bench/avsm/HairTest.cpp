// Light on strands by geometry, where the answer is known, and maps of curves beside it.
#include "Hair.h"
#include "reference/StrandLight.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <cmath>
#include <gl/ClipConvention.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace avsmbench;

namespace {

constexpr double kWidth = 0.002, kOpacity = 0.75, kPassed = 1 - kOpacity;

/// Joins points, each strand's own.
host::Strands strandsOf(const std::vector<std::vector<glm::dvec3>>& strands) {
  host::Strands result;
  for (const std::vector<glm::dvec3>& strand : strands)
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const auto index = static_cast<unsigned>(result.points.size());
      const glm::dvec3 tangent = glm::normalize(strand.back() - strand.front());
      result.points.push_back({strand[i], tangent, {kWidth, kOpacity}, glm::vec3(1)});
      if (i > 0) result.segments.emplace_back(index - 1, index);
    }
  return result;
}

/// Two combs that cross one another, each two teeth `apart`, wider than what is looked at, and a strand behind them.
host::Strands combs(double apart) {
  std::vector<std::vector<glm::dvec3>> strands(1);
  for (int i = 0; i <= 800; ++i)
    strands[0].push_back({-0.3 + 0.6 * i / 800, 0.001, -0.3});
  for (double y = -0.5; y <= 0.5; y += apart) {
    strands.push_back({{-0.5, y, 0.6}, {0.013, y, 0.6}, {0.5, y, 0.6}});
    strands.push_back({{y, -0.5, 0.2}, {y, 0.5, 0.2}});
  }
  return strandsOf(strands);
}

const glm::dvec3 kLamp(0, 0, 4);

tyndall::Light lamp() {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Spot;
  light.position = {kLamp.x, kLamp.y, kLamp.z};
  light.direction = {0, 0, -1};
  light.outerConeAngle = 0.1;
  const glm::dmat4 clip = glm::perspective(0.2, 1.0, 3.0, 5.0) * glm::lookAt(kLamp, glm::dvec3(0), glm::dvec3(0, 1, 0));
  light.shadow.views.push_back({host::toMat4(clip), 0});
  return light;
}

} // namespace

TEST_CASE("a strand stops its share of the light once, also at its joints, and nothing beside it") {
  const reference::StrandLight light(
      strandsOf({{{-1, 0, 1}, {0, 0, 1}, {1, 0, 1}}, {{0, -1, 2}, {0, 0.3, 2}}, {{0, 0.01, 3}, {0, 1, 3}}}));
  CHECK(light.transmittance({0, 0, 0}, kLamp) == Approx(kPassed * kPassed)); // through a joint, and one more
  CHECK(light.transmittance({0.5, 0, 0.5}, {0.5, 0, 4}) == Approx(kPassed));
  CHECK(light.transmittance({0.5, 0.49 * kWidth, 0}, {0.5, 0.49 * kWidth, 4}) == Approx(kPassed));
  CHECK(light.transmittance({0.5, 0.51 * kWidth, 0}, {0.5, 0.51 * kWidth, 4}) == 1);
  CHECK(light.transmittance({0, 0, 2.5}, kLamp) == 1);                // before both
  CHECK(light.transmittance({0, 0, 1}, kLamp, 0) == Approx(kPassed)); // on the first, which does not count
  CHECK(light.transmittance({0, 0, 1}, kLamp) == Approx(kPassed * kPassed));
}

TEST_CASE("of a footprint the strand covers what it covers of a disc") {
  const reference::StrandLight light(strandsOf({{{-1, 0, 1}, {1, 0, 1}}}));
  for (const double diameter : {2 * kWidth, 5 * kWidth}) {
    // Of a lamp that far away: rays are parallel.
    const double half = kWidth / diameter,
                 covered = (2 / glm::pi<double>()) * (std::asin(half) + half * std::sqrt(1 - half * half));
    CHECK(light.meanTransmittance({0, 0, 0}, {0, 0, 1e4}, -1, diameter, 4096) ==
          Approx(1 - kOpacity * covered).margin(2e-3));
  }
}

TEST_CASE("behind combs of strands a map of curves has the mean that geometry has over its texels") {
  if (tests::testContext().glVersion() < 43) {
    WARN("skipped: the context is older than OpenGL 4.3");
    return;
  }
  tyndall::AvsmConfig config;
  config.loader = tests::testContext().loader();
  config.size = 64;
  const tyndall::AvsmResult lists = tyndall::Avsm::create(config);
  REQUIRE(lists.avsm);
  // A texel is 0.0125 wide there, gaps between strands 0.005.
  const double apart = 0.005, passed = 1 - kOpacity * kWidth / apart;
  Hair hair(combs(apart), lamp(), 300);
  for (const char* method : {"lists", "avsm whole 8"}) {
    const std::vector<float> answers = hair.answers(methodNamed(method), *lists.avsm, config);
    const std::vector<double> truth = hair.truth(10 * apart);
    double mean = 0, meanTruth = 0;
    int count = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const glm::dvec3& place = hair.receivers()[i].place;
      if (place.z > 0) continue;
      mean += answers[i], meanTruth += truth[i], ++count;
      CHECK(truth[i] == Approx(passed * passed).margin(0.08)); // by 64 rays
      CHECK(answers[i] == Approx(truth[i]).margin(0.1));
    }
    REQUIRE(count > 100);
    CAPTURE(method);
    CHECK(mean / count == Approx(meanTruth / count).margin(0.02));
  }
}
