// What is said of the points where scene depth and a shadow map were compared.
#include "InputChecks.h"
#include "support/Catch.h"

using namespace tyndall;

namespace {

LightChecks checksOf(const InputCounts& surfaces, const InputCounts& casters) {
  return {2, false, false, surfaces, casters};
}

bool says(const LightChecks& checks, const std::string& words) {
  const std::vector<std::string> warnings = judge({checks});
  return warnings.size() == 1 && warnings.front().rfind("Frame::", 0) == 0 &&
         warnings.front().find(words) != std::string::npos;
}

} // namespace

TEST_CASE("full shadow, open sky and a few odd points are right") {
  CHECK(judge({}).empty());
  CHECK(judge({checksOf({0, 0, 2304}, {0, 0, 2304})}).empty());
  CHECK(judge({checksOf({2304}, {2304})}).empty());
  CHECK(judge({checksOf({0, 1000, 1288, 8, 8}, {0, 1000, 1288, 8, 8})}).empty());
  CHECK(judge({checksOf({0, 0, 0, 0, 0, 2304}, {0, 0, 0, 0, 0, 2304})}).empty()); // a lamp that shines elsewhere
}

TEST_CASE("points that cannot be are named by what shows them") {
  CHECK(
      says(checksOf({0, 1000, 1000, 304}, {0, 1000}), "lights[2].shadow: 23 % of the surfaces that the camera shows"));
  CHECK(says(checksOf({0, 100, 0, 10, 300}, {0, 1000}), "where the map has none"));
  CHECK(says(checksOf({0, 1000}, {0, 100, 0, 200}), "other near and far planes"));
  CHECK(says(checksOf({2304}, {0, 0, 0, 0, 200}), "sky in the scene depth"));
  CHECK(says(checksOf({0, 0, 2304, 0, 0, 0, 2304}, {0, 0, 100}), "texture coordinates"));
  CHECK(says(checksOf({0, 0, 2304}, {0, 0, 300, 0, 0, 0, 300}), "less than a quarter of the distance"));
  CHECK(
      says(checksOf({0, 0, 2304, 0, 0, 0, 0, 2304}, {}), "Frame::depth: 100 % of the surfaces are at the near plane"));
}

TEST_CASE("a sun is everywhere; smoke and hair may be where its map shows nothing") {
  LightChecks sun = checksOf({0, 0, 0, 0, 0, 2304}, {});
  sun.isSun = true;
  CHECK(says(sun, "no visible surface lies in its views"));
  LightChecks hair = checksOf({0, 100, 0, 0, 300}, {0, 1000});
  hair.isHazy = true;
  CHECK(judge({hair}).empty());
}
