// Lights of a random frame, in every relation to its camera.
#include "Case.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace stress {

namespace {

/// Where a lamp stands.
glm::dvec3 lampPlace(const Case& made, Random& random) {
  const EyeFrame eye(made.frame.camera);
  const glm::dvec3 &right = eye.axes[0], &up = eye.axes[1];
  const double distance = random.logUniform(0.1, 20);
  const glm::dvec3 aside = std::cos(distance) * right + std::sin(distance) * up;
  switch (random.integer(0, 9)) {
  case 0:
    return eye.position;
  case 1:
    return eye.position + 1e-6 * random.direction();
  case 2:
    return eye.position - distance * eye.forward(); // behind
  case 3:
    return eye.position + distance * aside; // on the plane of the view
  case 4:
    return eye.position + distance * aside + 1e-6 * distance * eye.forward(); // next to it
  case 5:
    return eye.position + distance * pixelDirection(made, random); // on a pixel's ray
  case 6:
    return eye.position + distance * eye.forward();
  case 7:
    return eye.position + 1e3 * random.direction();
  default:
    return eye.position + 6.0 * eye.forward() + distance * random.direction();
  }
}

/// Where light travels to.
glm::dvec3 lightDirection(const Case& made, const glm::dvec3& position, Random& random) {
  const EyeFrame eye(made.frame.camera);
  const glm::dvec3 &right = eye.axes[0], &up = eye.axes[1];
  const double angle = random.uniform(0, 6.28);
  const glm::dvec3 aside = std::cos(angle) * right + std::sin(angle) * up;
  switch (random.integer(0, 9)) {
  case 0:
    return eye.forward();
  case 1:
    return -eye.forward();
  case 2:
    return aside; // the epipole at infinity
  case 3:
    return aside + random.pick({-1.0, 1.0}) * random.logUniform(1e-7, 1e-2) * eye.forward();
  case 4:
    return pixelDirection(made, random);
  case 5:
    return -pixelDirection(made, random);
  case 6:
    return glm::length(eye.position - position) > 0 ? eye.position - position : eye.forward();
  case 7:
    return random.pick({glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)});
  default:
    return random.direction();
  }
}

void makeCone(Light& light, const AxisSet& simple, Random& random) {
  light.outerConeAngle = 0.6;
  light.innerConeAngle = 0.4;
  if (simple.has(Axis::Cones)) return;
  const double degrees = random.chance(0.5)
                             ? random.uniform(5, 70)
                             : random.pick({random.logUniform(0.01, 5), random.uniform(70, 89.9), 89.9, 0.01});
  light.outerConeAngle = glm::radians(degrees);
  light.innerConeAngle = light.outerConeAngle * random.pick({0.0, 1.0, random.uniform(), 1 - 1e-7});
  if (random.chance(0.3)) light.range = random.logUniform(0.1, 100);
}

void makeRadiance(Light& light, const AxisSet& simple, Random& random) {
  light.colour = light.kind == LightKind::Directional ? Rgb{1, 0.9F, 0.8F} : Rgb{20, 18, 16};
  if (simple.has(Axis::Radiance)) return;
  const double level = random.chance(0.5) ? 1 : random.logUniform(1e-8, 1e8);
  for (float& channel : light.colour)
    channel = static_cast<float>(level * random.logUniform(0.1, 10));
  if (random.chance(0.1)) light.colour[static_cast<std::size_t>(random.integer(0, 2))] = 0;
}

void makeBoundary(Light& light, bool wanted, Random& random) {
  const glm::dvec3 travel = glm::normalize(reference::toVec3(light.direction));
  const glm::dvec3 normal = random.direction();
  if (!wanted || light.kind != LightKind::Directional || std::abs(glm::dot(travel, normal)) < 0.05) return;
  light.boundary = {true, toVec3(random.uniform(-5, 5) * random.direction()), toVec3(normal)};
}

} // namespace

void makeLights(Case& made, const AxisSet& simple) {
  Random lights = Random::ofFamily(made.seed, Axis::Lights);
  Random places(made.seed, Axis::Places), cones(made.seed, Axis::Cones), radiance(made.seed, Axis::Radiance);
  const int count = simple.has(Axis::Lights) || lights.chance(0.7) ? 1 : lights.integer(2, 4);
  for (int i = 0; i < count; ++i) {
    Light light;
    light.kind = static_cast<LightKind>(lights.integer(0, 2)); // also at its simplest: there is no simpler kind
    light.litOutsideViews = lights.chance(0.7);
    const bool hasBoundary = lights.chance(0.15);
    if (simple.has(Axis::Places)) {
      light.direction = {0.4, -1, -0.3};
      light.position = {-0.7, 2.5, 0.4};
    } else {
      const glm::dvec3 position = lampPlace(made, places);
      light.position = toVec3(position);
      light.direction = toVec3(lightDirection(made, position, places));
      makeBoundary(light, hasBoundary, places);
    }
    makeCone(light, simple, cones);
    makeRadiance(light, simple, radiance);
    made.frame.lights.push_back(light);
  }
}

} // namespace stress
