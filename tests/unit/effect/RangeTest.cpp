// Frames whose numbers are doubles, but nothing that 32-bit floats hold: refused by field, since shaders would be given
// infinities.
#include "CheckFrame.h"
#include "optics/Blocks.h"
#include "support/Catch.h"
#include "unit/optics/OpticsCases.h"

using namespace tyndall;

namespace {

Frame valid() {
  Frame frame = tests::frameOf(tests::cameraOf(tests::projections().front(), {3, -2, 7}, {0.4, -0.2, -1}), 64, 40);
  frame.colour = 1;
  frame.lights = {tests::sun({0.2, -1, 0.3}), tests::lamp({1, 2, 3})};
  for (Light& light : frame.lights) {
    light.shadow.texture = 2;
    light.shadow.array = true;
    tests::addViews(light, tests::kConventions[0], {0, 0, 0}, 10);
  }
  return frame;
}

void checkRefused(const Frame& frame, const std::string& line) {
  const Status status = checkValues(frame);
  CHECK(status.code == StatusCode::InvalidFrame);
  CHECK(status.message == line + ": must be finite as 32-bit floats, relative to the eye");
}

} // namespace

TEST_CASE("numbers that 32-bit floats do not hold are refused by field") {
  REQUIRE(checkValues(valid()).message.empty());
  Frame frame = valid();
  frame.lights[0].boundary = {true, {0, 1e300, 0}, {0, 1, 0}};
  checkRefused(frame, "Frame::lights[0].boundary");
  frame = valid();
  for (double& element : frame.lights[1].shadow.views[3].clipFromWorld)
    element *= 1e45;
  checkRefused(frame, "Frame::lights[1].shadow.views[3]");
  frame = valid();
  frame.lights[1].shadow.views.clear();
  frame.lights[1].shadow.cube = {true, 0, 1e-200, 1e200, false};
  checkRefused(frame, "Frame::lights[1].shadow.cube");
  frame = valid();
  frame.depth.encoding = DepthEncoding::Axial;
  frame.depth.scale.unit = 1e40;
  checkRefused(frame, "Frame::depth.scale");
  frame = valid();
  frame.camera.viewFromWorld[12] = 1e300;
  CHECK(checkValues(frame).code == StatusCode::InvalidFrame);
}

TEST_CASE("directions may have any length, also one whose square is no double") {
  Frame frame = valid();
  for (const double length : {1e-300, 1e-20, 1.0, 1e20, 1e300}) {
    CAPTURE(length);
    frame.lights[0].direction = {0.6 * length, -0.8 * length, 0};
    frame.lights[0].boundary = {true, {0, 4, 0}, {0, length, 0}};
    REQUIRE(checkValues(frame).message.empty());
    const blocks::LightBlock block = optics::lightBlock(frame, frame.lights[0], 0, 0);
    CHECK(glm::distance(block.lightDirection, glm::vec3(0.6F, -0.8F, 0)) < 1e-6F);
    CHECK(block.boundary.y == Approx(-1.25));
  }
}

TEST_CASE("lights and extinctions beyond 32-bit floats are given to shaders as those at their ends") {
  Frame frame = valid();
  frame.lights[0].position = {kInfinity, kInfinity, -kInfinity}; // which a sun does not use
  frame.lights[1].position = {0, 1e200, -1e39};
  for (Constituent& one : frame.medium.constituents)
    one.scattering = {3e38F, 1, 1};
  frame.medium.absorption = {3e38F, 1, 1};
  REQUIRE(checkValues(frame).message.empty());
  CHECK(optics::frameBlock(frame, {}).extinction.x == 3e38F);
  CHECK(optics::lightBlock(frame, frame.lights[0], 64, 64).lightPosition == glm::vec3(0));
  const blocks::LightBlock lamp = optics::lightBlock(frame, frame.lights[1], 64, 64);
  CHECK(lamp.lightPosition.y == 3e38F);
  CHECK(lamp.lightPosition.z == -3e38F);
  CHECK(std::isfinite(lamp.shadowViews[0].margin.x));
}

TEST_CASE("a range is never so short or long that it comes to be none or infinite") {
  Frame frame = valid();
  for (const double range : {1e-320, 1e-60, 1e-20, 1e20, 1e37}) {
    frame.lights[1].range = range;
    const float shown = optics::lightBlock(frame, frame.lights[1], 0, 0).lightRange;
    CAPTURE(range, shown);
    CHECK(shown > 0);
    CHECK(std::isfinite(shown));
  }
  for (const double endless : {1e39, 1e300, kInfinity}) {
    frame.lights[1].range = endless;
    CHECK(optics::lightBlock(frame, frame.lights[1], 0, 0).lightRange == 0);
  }
}
