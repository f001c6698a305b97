// What is read off the curves, on numbers that can be checked by hand.
#include "Analysis.h"
#include "support/Catch.h"

namespace {

const std::vector<bench::Point> kCurve = {{10, 0.4}, {40, 0.1}, {20, 0.5}, {160, 0.025}};

bench::Result result(const std::string& technique, double milliseconds, double rRmse,
                     const std::string& series = "curve", double x = 0) {
  bench::Result r;
  r.setup.series = series;
  r.setup.x = x;
  r.setup.scene = "nave";
  r.technique = bench::parseTechnique(technique);
  r.milliseconds = {milliseconds, milliseconds + 1, milliseconds - 1};
  r.errors["exact"].rRmse = rRmse;
  return r;
}

} // namespace

TEST_CASE("the time for an error lies between the points around it") {
  CHECK(*bench::timeForError(kCurve, 0.4) == Approx(10));
  CHECK(*bench::timeForError(kCurve, 0.9) == Approx(10));
  CHECK(*bench::timeForError(kCurve, 0.2) == Approx(20)); // the point at 20 ms is worse than a faster one
  CHECK(*bench::timeForError(kCurve, 0.05) == Approx(80));
  CHECK(*bench::timeForError(kCurve, 0.025) == Approx(160));
  CHECK_FALSE(bench::timeForError(kCurve, 0.02));
  CHECK_FALSE(bench::timeForError({}, 0.02));
}

TEST_CASE("the error at a time lies between the points around it") {
  CHECK_FALSE(bench::errorAtTime(kCurve, 9));
  CHECK(*bench::errorAtTime(kCurve, 20) == Approx(0.2));
  CHECK(*bench::errorAtTime(kCurve, 1000) == Approx(0.025));
}

TEST_CASE("a profile is compared with the best of each group") {
  const std::vector<bench::EqualError> rows =
      bench::equalErrors({result("high", 10, 0.1), result("fixed:16", 10, 0.4), result("fixed:64", 40, 0.1),
                          result("half:16", 5, 0.3), result("half:64", 20, 0.2), result("tree", 30, 0.05)});
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].best == "fixed");
  CHECK(*rows[0].bestTime == Approx(40));
  CHECK(rows[0].nearest == "half");
  CHECK(*rows[0].bestError == Approx(0.2449).margin(1e-3));
  CHECK(rows[1].group == bench::Group::Research);
  CHECK(*rows[1].bestTime == Approx(30));
  CHECK_FALSE(rows[1].bestError);
}

TEST_CASE("the exponent of a power law is found") {
  std::vector<bench::Result> results;
  for (const double x : {1.0, 2.0, 4.0, 8.0})
    results.push_back(result("high", 100 * x * x, 0.1, "shadow", x));
  const std::vector<bench::Growth> rows = bench::growths(results);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].exponent == Approx(2));
  CHECK(rows[0].range == Approx(8));
}

TEST_CASE("technique names") {
  CHECK(bench::parseTechnique("froxels:8x9x10").parameters == std::vector<int>{8, 9, 10});
  CHECK(bench::parseTechnique("epipolar:512x640").family == "epipolar");
  CHECK(bench::settingsFor(bench::parseTechnique("target:25")).errorTarget == 0.025F);
  for (const char* name : {"", "fixed", "fixed:", "fixed:0", "fixed:16x", "fixed:16x16", "fixed:-4", "exact:1",
                           "froxels:8x9", "epipolar:512x100", "target", "target:0", "target:1001", "nothing", "high:"})
    CHECK_THROWS_AS(bench::parseTechnique(name), std::invalid_argument);
  for (const std::string& name : bench::allTechniques())
    CHECK_NOTHROW(bench::parseTechnique(name));
}
