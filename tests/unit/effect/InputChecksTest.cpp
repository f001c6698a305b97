// What is said of the points where scene depth and a shadow map were compared.
#include "InputChecks.h"
#include "support/Catch.h"

using namespace tyndall;

namespace {

LightChecks checksOf(const InputCounts& surfaces, const InputCounts& casters) { return {{2}, surfaces, casters}; }

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
  CHECK(says(checksOf({0, 0, 2304}, {0, 0, 300, 0, 0, 0, 300}), "less than a quarter of the distance"));
  CHECK(
      says(checksOf({0, 0, 2304, 0, 0, 0, 0, 2304}, {}), "Frame::depth: 100 % of the surfaces are at the near plane"));
}

TEST_CASE("a sun is everywhere; smoke and hair may be where its map shows nothing") {
  LightChecks sun = checksOf({0, 0, 0, 0, 0, 2304}, {});
  sun.light.isSun = true;
  CHECK(says(sun, "no visible surface lies in its views"));
  LightChecks hair = checksOf({0, 100, 0, 0, 300}, {0, 1000});
  hair.light.isHazy = true;
  CHECK(judge({hair}).empty());
}

TEST_CASE("a mistake that would explain what is found is named, and the fields that the light has") {
  const auto hinted = [](Hint hint) {
    InputCounts surfaces{0, 10, 700, 200};
    surfaces.hints[static_cast<std::size_t>(hint)] = 600;
    return checksOf(surfaces, {0, 1000});
  };
  CHECK(says(hinted(Hint::Biased), "it would agree if clipFromWorld is a matrix for texture coordinates"));
  CHECK(says(hinted(Hint::WholeLayer), "into the whole layer"));
  CHECK(says(hinted(Hint::FromTop), "rectangle counts rows from the top"));
  CHECK(says(hinted(Hint::OtherView), "another order than their layers or rectangles"));
  LightChecks cube = hinted(Hint::OtherView);
  cube.light.isCube = true;
  CHECK(says(cube, "faces are in another order than GL's"));
  cube = hinted(Hint::Turned);
  cube.light.isCube = true;
  CHECK(says(cube, "faces are upside down"));
  CHECK(says(checksOf({0, 0, 2304, 0, 0, 0, 0, 0, {900}}, {0, 0, 100}), "hardly a surface that the camera shows"));
  CHECK(judge({checksOf({0, 1000, 1000, 0, 0, 0, 0, 0, {900}}, {})}).empty()); // a look-alike of what is right

  cube = checksOf({0, 100, 0, 300}, {0, 1000});
  cube.light.isCube = cube.light.hasDistances = true;
  CHECK(says(cube, "cube.nearDistance, cube.farDistance, the faces' order, their up vectors, encoding, scale"));
  LightChecks atlas = checksOf({0, 100, 0, 300}, {0, 1000});
  atlas.light.hasRectangles = true;
  CHECK(says(atlas, "clipFromWorld, rectangle, clipDepth"));
  CHECK(says(atlas, "of the first light: put this one there"));
}

TEST_CASE("what is wrong in one view alone is not lost among the others") {
  LightChecks cube = checksOf({0, 1900, 0, 0, 80}, {0, 1000});
  cube.light.isCube = true;
  cube.byView.resize(6);
  cube.byView[0] = {0, 1800};
  cube.byView[5] = {0, 100, 0, 0, 80};
  CHECK(says(cube, "4 % of the surfaces that the camera shows lit are where the map has none, nearly all in face -z"));
  cube.byView[5].agree = 300;
  CHECK(judge({cube}).empty());
}

TEST_CASE("a map that is all at its near plane is not blamed on the scene depth") {
  InputCounts map{2304};
  map.atNear = 2304;
  CHECK(says(checksOf({0, 0, 2304}, map), "100 % of the map is at its near plane"));
}
