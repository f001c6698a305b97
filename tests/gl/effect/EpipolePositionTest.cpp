// Technique epipolar against exact with the light in every place that is special to its slices. Compared are the
// picture, its outermost pixels and those around the epipole.
#include "ShaftRig.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kWidth = 96, kHeight = 64;

// Where the light is: a window position in pixels, before (w = 1) or behind (w = -1) the eye, or at infinity (w = 0) in
// a direction of the image.
struct Epipole {
  std::string name;
  double x, y, w;
};

const std::vector<Epipole> kOnScreen = {
    {"anywhere", 60.3, 40.7, 1},       {"pixel centre", 30.5, 40.5, 1},    {"pixel edge", 30, 40.5, 1},
    {"pixel corner", 30, 41, 1},       {"image centre", 48, 32, 1},        {"bottom left corner", 0, 0, 1},
    {"bottom right corner", 96, 0, 1}, {"top left corner", 0, 64, 1},      {"top right corner", 96, 64, 1},
    {"left edge", 0, 20.5, 1},         {"outermost centre", 0.5, 20.5, 1}, {"corner pixel's centre", 0.5, 0.5, 1},
    {"just inside", 95.501, 40.5, 1},  {"top edge", 50.2, 64, 1},
};
const std::vector<Epipole> kOffScreen = {
    {"off left", -30, 20, 1},         {"off right", 130, 20, 1},        {"off bottom", 40, -25, 1},
    {"off top", 40, 90, 1},           {"off bottom left", -40, -30, 1}, {"off top right", 140, 100, 1},
    {"off bottom right", 100, -4, 1}, {"off top left", -4, 70, 1},      {"just off", -0.01, 30.5, 1},
    {"far off", 3000, 500, 1},
};
const std::vector<Epipole> kBehind = {
    {"behind", 60.3, 40.7, -1},      {"behind, centre", 48, 32, -1},       {"behind, pixel centre", 30.5, 40.5, -1},
    {"behind, corner", 0, 64, -1},   {"behind, off left", -30, 20, -1},    {"behind, off top right", 140, 100, -1},
    {"at infinity, right", 1, 0, 0}, {"at infinity, left", -1, 0, 0},      {"at infinity, up", 0, 1, 0},
    {"at infinity, down", 0, -1, 0}, {"at infinity, aslant", 0.6, 0.8, 0},
};

// From the eye to the light in view space; the lamp's distance is three times its length.
glm::dvec3 viewDirection(const tests::SceneRig& scene, const Epipole& e) {
  const Mat4& clip = scene.frame.camera.clipFromView;
  if (e.w == 0) return {e.x, e.y, 0};
  return {e.w * (2 * e.x / kWidth - 1) / clip[0], e.w * (2 * e.y / kHeight - 1) / clip[5], -e.w};
}

// The rig with its light; upside down where the light would be below the floor.
Light& place(tests::ShaftRig& rig, LightKind kind, const Epipole& epipole) {
  const glm::dvec3 direction = viewDirection(rig.scene, epipole);
  const double up = direction.y < 0 ? -1 : 1;
  const glm::dmat4 roll = glm::scale(glm::dmat4(1), glm::dvec3(up, up, 1));
  rig.look(tests::toMat4(roll * glm::translate(glm::dmat4(1), glm::dvec3(0, -2, 0))));
  const glm::dvec3 world(up * direction.x, up * direction.y, direction.z);
  Light light = tests::shaftLight(kind);
  if (kind == LightKind::Directional) {
    light.direction = {-world.x, -world.y, -world.z};
  } else {
    const glm::dvec3 position = glm::dvec3(0, 2, 0) + 3.0 * world, aim = glm::dvec3(0.5, 1, -7) - position;
    light.position = {position.x, position.y, position.z};
    light.direction = {aim.x, aim.y, aim.z};
  }
  return rig.addLight(light, kind == LightKind::Directional ? 256 : 64);
}

void checkRegion(tests::ShaftRig& rig, const reference::Image& image, const std::string& name,
                 const tests::PixelSet& where) {
  const tests::ShaftError error = rig.error(image, where);
  CAPTURE(name, error.rRmse, error.displaced);
  CHECK(error.rRmse <= error.displaced + 0.02);
}

void checkEpipole(LightKind kind, const Epipole& epipole) {
  CAPTURE(static_cast<int>(kind), epipole.name);
  tests::ShaftRig rig(kWidth, kHeight);
  place(rig, kind, epipole);
  const reference::Image image = rig.picture(Technique::Epipolar);
  checkRegion(rig, image, "picture", [](int, int) { return true; });
  checkRegion(rig, image, "border",
              [](int x, int y) { return x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1; });
  checkRegion(rig, image, "silhouettes", [&](int x, int y) {
    const auto distance = [&](int u, int v) { return rig.scene.distances[static_cast<std::size_t>(v * kWidth + u)]; };
    const auto differs = [&](int u, int v) {
      return u < kWidth && v < kHeight && std::abs(std::log(distance(u, v) / distance(x, y))) > 0.1;
    };
    return differs(x + 1, y) || differs(x, y + 1);
  });
  if (epipole.w != 0 && epipole.x > -3 && epipole.x < kWidth + 3 && epipole.y > -3 && epipole.y < kHeight + 3)
    checkRegion(rig, image, "epipole",
                [&](int x, int y) { return std::hypot(x + 0.5 - epipole.x, y + 0.5 - epipole.y) < 3.5; });
}

void checkAll(LightKind kind) {
  for (const std::vector<Epipole>& epipoles : {kOnScreen, kOffScreen, kBehind})
    for (const Epipole& epipole : epipoles)
      checkEpipole(kind, epipole);
}

} // namespace

TEST_CASE("epipolar comes close to exact wherever a sun's epipole lies", "[sweep]") {
  checkAll(LightKind::Directional);
}
TEST_CASE("epipolar comes close to exact wherever a point light's epipole lies", "[sweep]") {
  checkAll(LightKind::Point);
}
TEST_CASE("epipolar comes close to exact wherever a spot light's epipole lies", "[sweep]") {
  checkAll(LightKind::Spot);
}
