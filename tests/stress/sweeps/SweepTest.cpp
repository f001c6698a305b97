// No pose of camera and light makes the picture jump where exact's does not, and at none does its error stand out.
#include "Curve.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace sweeps;
using tyndall::Technique;

namespace {

constexpr double kFine = 1.1e-3;  // of a sweep's unit: steps in which exact hardly moves
constexpr double kUnseen = 0.002; // of the mean: a change that is no jump
constexpr double kAllowed = 0.02; // beyond displacement, as of every epipole's place (EpipolePositionTest.cpp)

double medianError(Curve curve) {
  const auto middle = curve.begin() + static_cast<std::ptrdiff_t>(curve.size() / 2);
  std::nth_element(curve.begin(), middle, curve.end(),
                   [](const Point& a, const Point& b) { return a.error < b.error; });
  return middle->error;
}

// What a fine step may change beyond what it changes in exact: a share of what half a pixel or texel does there.
void checkJumps(const Sweep& sweep, const Curve& curve, double share) {
  int steps = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].t - curve[i - 1].t > kFine) continue;
    ++steps;
    CAPTURE(sweep.name, curve[i - 1].t, curve[i].t, curve[i].change, curve[i].exactChange);
    if (curve[i].jump() > kUnseen) CHECK(curve[i].jump() <= share * displaced(sweep, curve[i]));
  }
  CHECK(steps >= 6); // on either side of what is special
}

void checkErrors(const Sweep& sweep, const Curve& curve) {
  const double median = medianError(curve);
  for (const Point& point : curve) {
    CAPTURE(sweep.name, point.t, point.error, median);
    CHECK(std::isfinite(point.error));
    if (point.error > std::max(3 * median, kUnseen)) CHECK(point.error <= displaced(sweep, point) + kAllowed);
  }
}

void check(const std::string& kind, Technique technique, double share) {
  int found = 0;
  for (const Sweep& sweep : allSweeps()) {
    if (sweep.name.find(kind) == std::string::npos) continue;
    ++found;
    const Curve curve = curveOf(sweep, technique);
    checkJumps(sweep, curve, share);
    checkErrors(sweep, curve);
  }
  CHECK(found > 0);
}

constexpr double kTenth = 0.1, kWhole = 1;

} // namespace

TEST_CASE("a light across each edge of the picture makes no jump") { check("edge", Technique::Epipolar, kTenth); }
TEST_CASE("a light across each corner of the picture makes no jump") { check("corner", Technique::Epipolar, kTenth); }
TEST_CASE("a camera that rolls sees no jump") { check("roll", Technique::Epipolar, kTenth); }
TEST_CASE("an eye through a cone's wall, its tip and its map's near plane sees no jump") {
  for (const char* kind : {"through the wall", "the tip", "near plane"})
    check(kind, Technique::Epipolar, kTenth);
}
TEST_CASE("an eye into a lamp, out of it and past it sees no jump") {
  for (const char* kind : {"lamp, into", "lamp, past", "lamp, ahead"})
    check(kind, Technique::Epipolar, kTenth);
}
TEST_CASE("an eye through a cascade's seam sees no jump") { check("seam", Technique::Epipolar, kTenth); }

// In the plane of the eye the light's place leaps from one side of the picture to the other, and with it where slices
// are anchored: the approximation is another, as good.
TEST_CASE("a light through infinity changes no more than half a pixel or texel does") {
  check("infinity", Technique::Epipolar, kWhole);
}

// Each pixel takes its nearest slice: where many lie between two, as with lines along rows, they change together.
TEST_CASE("technique tree changes no more than half a pixel or texel does, whatever the pose") {
  for (const char* kind : {"infinity", "sun, bottom", "seam", "hard spot"})
    check(kind, Technique::Tree, kWhole);
}

TEST_CASE("the curves of all sweeps, into sweeps.csv", "[.][curves]") {
  std::ofstream csv("sweeps.csv");
  writeHeader(csv);
  for (const Sweep& sweep : allSweeps())
    for (const auto& [technique, name] :
         {std::pair{Technique::Epipolar, "epipolar"}, std::pair{Technique::Tree, "tree"}})
      write(csv, sweep.name, name, curveOf(sweep, technique, 10));
  REQUIRE(csv.flush());
}
