// No pose of camera and light makes the picture jump where exact's does not.
#include "Curve.h"
#include "support/Catch.h"

#include <fstream>

using namespace sweeps;
using tyndall::Technique;

TEST_CASE("the curves of all sweeps, into sweeps.csv", "[.][curves]") {
  std::ofstream csv("sweeps.csv");
  writeHeader(csv);
  for (const Sweep& sweep : allSweeps())
    for (const auto& [technique, name] :
         {std::pair{Technique::Epipolar, "epipolar"}, std::pair{Technique::Tree, "tree"}})
      write(csv, sweep.name, name, curveOf(sweep, technique, 10));
  REQUIRE(csv.flush());
}

TEST_CASE("placeholder") { CHECK(!allSweeps().empty()); }
