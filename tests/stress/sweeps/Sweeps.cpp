#include "Sweeps.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

using namespace tyndall;

namespace sweeps {

namespace {

constexpr int kWidth = 64, kHeight = 48, kMapSize = 128;
const glm::dvec3 kEye(0, 2, 0);

constexpr LightKind kKinds[] = {LightKind::Directional, LightKind::Point, LightKind::Spot};
const char* nameOf(LightKind kind) {
  return kind == LightKind::Directional ? "sun" : kind == LightKind::Point ? "lamp" : "spot";
}

std::unique_ptr<tests::ShaftRig> rigOf(const Light& light) {
  auto rig = std::make_unique<tests::ShaftRig>(kWidth, kHeight);
  rig->addLight(light, kMapSize);
  return rig;
}

// From the eye to the light; the sun's is a direction.
glm::dvec3 towardsLight(const Light& light) {
  return light.kind == LightKind::Directional ? -reference::toVec3(light.direction)
                                              : reference::toVec3(light.position) - kEye;
}

// Turns the camera at kEye so that the light is in that direction of view space.
void turnTo(tests::ShaftRig& rig, const glm::dvec3& viewDirection) {
  const glm::dvec3 world = glm::normalize(towardsLight(rig.scene.frame.lights[0])),
                   view = glm::normalize(viewDirection);
  const glm::dvec3 axis = glm::cross(world, view);
  const double sine = glm::length(axis), angle = std::atan2(sine, glm::dot(world, view));
  const glm::dmat4 turn = sine > 0 ? glm::rotate(glm::dmat4(1), angle, axis / sine) : glm::dmat4(1);
  rig.look(tests::toMat4(turn * glm::translate(glm::dmat4(1), -kEye)));
}

// The view-space direction of a window position in pixels.
glm::dvec3 directionAt(const tests::ShaftRig& rig, const glm::dvec2& pixel, double w) {
  const Mat4& clip = rig.scene.frame.camera.clipFromView;
  const glm::dvec2 ndc = 2.0 * pixel / glm::dvec2(kWidth, kHeight) - 1.0;
  return {w * ndc.x / clip[0], w * ndc.y / clip[5], -w};
}

// The light across each edge and corner of the picture, before the eye and behind it.
void addEdges(std::vector<Sweep>& all, LightKind kind) {
  struct Place {
    const char* name;
    glm::dvec2 pixel, outward;
  };
  const double r = std::sqrt(0.5);
  const Place places[] = {{"left edge", {0, 20.3}, {-1, 0}},          {"right edge", {kWidth, 20.3}, {1, 0}},
                          {"bottom edge", {25.4, 0}, {0, -1}},        {"top edge", {25.4, kHeight}, {0, 1}},
                          {"bottom left corner", {0, 0}, {-r, -r}},   {"bottom right corner", {kWidth, 0}, {r, -r}},
                          {"top left corner", {0, kHeight}, {-r, r}}, {"top right corner", {kWidth, kHeight}, {r, r}}};
  for (const double w : {1.0, -1.0})
    for (const Place& place : places)
      all.push_back({std::string(nameOf(kind)) + (w > 0 ? ", " : ", behind, ") + place.name, "pixels", ladder(1, 3),
                     [kind] { return rigOf(tests::shaftLight(kind)); },
                     [place, w](tests::ShaftRig& rig, double t) {
                       turnTo(rig, directionAt(rig, place.pixel + t * place.outward, w));
                     }});
}

// Through the plane of the eye, in which the light's place in the picture goes through infinity.
void addInfinity(std::vector<Sweep>& all, LightKind kind) {
  struct Way {
    const char* name;
    glm::dvec2 direction;
  };
  for (const Way& way : {Way{"right", {1, 0}}, Way{"up", {0, 1}}, Way{"aslant", {-0.6, 0.8}}})
    all.push_back({std::string(nameOf(kind)) + ", through infinity, " + way.name, "w", ladder(0.1, 3),
                   [kind] { return rigOf(tests::shaftLight(kind)); },
                   [way](tests::ShaftRig& rig, double t) { turnTo(rig, {way.direction, -t}); }});
}

// The camera rolls about its axis, the light in the picture or beside it.
void addRolls(std::vector<Sweep>& all, LightKind kind) {
  std::vector<double> degrees = ladder(1);
  for (int i = 2; i <= 90; i += 4)
    degrees.push_back(i);
  const glm::dvec2 pixels[] = {{40.2, 30.7}, {90.2, 30.7}};
  for (const glm::dvec2& pixel : pixels)
    all.push_back({std::string(nameOf(kind)) + (pixel.x < kWidth ? ", roll" : ", roll, beside the picture"), "degrees",
                   degrees, [kind] { return rigOf(tests::shaftLight(kind)); },
                   [pixel](tests::ShaftRig& rig, double t) {
                     turnTo(rig, directionAt(rig, pixel, 1));
                     const glm::dmat4 roll = glm::rotate(glm::dmat4(1), glm::radians(t), glm::dvec3(0, 0, 1));
                     rig.look(tests::toMat4(roll * reference::toMat4(rig.scene.frame.camera.viewFromWorld)));
                   }});
}

// The eye goes from `place` by t along `way`, looking along `gaze`.
Sweep dolly(const std::string& name, const Light& light, const glm::dvec3& place, const glm::dvec3& way,
            const glm::dvec3& gaze, double reach) {
  return {name, "world units", ladder(reach, 4), [light] { return rigOf(light); },
          [=](tests::ShaftRig& rig, double t) {
            const glm::dvec3 eye = place + t * glm::normalize(way);
            rig.look(tests::lookAt(eye, eye + gaze));
          }};
}

void addDollies(std::vector<Sweep>& all) {
  const glm::dvec3 ahead(0.1, -0.05, -1), aside(1, 0.2, 0.1);
  Light spot = tests::shaftLight(LightKind::Spot), hard = spot;
  hard.innerConeAngle = hard.outerConeAngle; // a step at the wall
  const glm::dvec3 tip = reference::toVec3(spot.position), axis = glm::normalize(reference::toVec3(spot.direction));
  const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
  const glm::dvec3 wall = tip + 3.0 * (std::cos(spot.outerConeAngle) * axis + std::sin(spot.outerConeAngle) * side);
  constexpr double kMapNear = 0.1; // of shadowViews
  for (const Light& light : {spot, hard}) {
    const std::string name = light.innerConeAngle < light.outerConeAngle ? "spot" : "hard spot";
    all.push_back(dolly(name + ", through the wall", light, wall, side, ahead, 0.3));
    all.push_back(dolly(name + ", through the tip, along the axis", light, tip, axis, ahead, 0.3));
    all.push_back(dolly(name + ", through the tip, across", light, tip, side, ahead, 0.3));
    all.push_back(dolly(name + ", past the tip", light, tip + 0.05 * axis, side, ahead, 0.3));
    all.push_back(
        dolly(name + ", through its map's near plane", light, tip + kMapNear * axis + 0.03 * side, axis, ahead, 0.08));
  }
  const Light lamp = tests::shaftLight(LightKind::Point);
  all.push_back(dolly("lamp, into it and out of it", lamp, tip, aside, ahead, 0.3));
  all.push_back(dolly("lamp, past it", lamp, tip + glm::dvec3(0, 0.05, 0), aside, ahead, 0.3));
  all.push_back(dolly("lamp, ahead of it", lamp, tip + glm::dvec3(0, 0, 0.5), glm::dvec3(0, 0, -1), ahead, 0.6));
}

// The eye goes through the side of the finest cascade.
void addSeams(std::vector<Sweep>& all) {
  Light sun = tests::shaftLight(LightKind::Directional);
  sun.shadow.views = tests::shadowViews(sun, 3);
  const glm::dmat4 worldFromClip = glm::inverse(reference::toMat4(sun.shadow.views[0].clipFromWorld));
  const glm::dvec3 across = glm::normalize(glm::dvec3(worldFromClip[0]));
  const glm::dvec3 half = glm::dvec3(worldFromClip[0]); // from the middle to the side
  const glm::dvec3 seam = kEye + glm::dot(half, across) * across;
  for (const double fade : {0.0, 0.2}) {
    Light light = sun;
    light.cascadeFade = fade;
    all.push_back(dolly(fade > 0 ? "cascades that fade, through a seam" : "cascades, through a seam", light, seam,
                        across, -across + glm::dvec3(0, 0, -0.5), 0.5));
  }
}

} // namespace

std::vector<double> ladder(double greatest, int even) {
  std::vector<double> at = {0};
  for (double decade = 1e-6; decade < 1.5; decade *= 10)
    for (const double sign : {-1.0, 1.0})
      at.push_back(sign * decade * greatest);
  for (int i = 2; i < 2 + even; ++i)
    for (const double sign : {-1.0, 1.0})
      at.push_back(sign * i * greatest);
  std::sort(at.begin(), at.end());
  return at;
}

std::vector<Sweep> allSweeps() {
  std::vector<Sweep> all;
  for (const LightKind kind : kKinds) {
    addEdges(all, kind);
    addInfinity(all, kind);
    addRolls(all, kind);
  }
  addDollies(all);
  addSeams(all);
  return all;
}

} // namespace sweeps
