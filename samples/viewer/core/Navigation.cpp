#include "Navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <scene/Projection.h>

namespace viewer {

namespace {

constexpr double kMostPitch = 1.55; ///< radians, of a quarter turn of 1.5708
constexpr double kLeastDistance = 1e-6;

struct Axes {
  glm::dvec3 forward, right, up;
};

Axes axesOf(const LookAt& view) {
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  const glm::dvec3 aside = glm::cross(forward, glm::dvec3(0, 1, 0));
  const glm::dvec3 right = glm::length(aside) > 1e-9 ? glm::normalize(aside) : glm::dvec3(1, 0, 0);
  return {forward, right, glm::cross(right, forward)};
}

/// The direction turned about the y axis, and raised.
glm::dvec3 turnedDirection(const glm::dvec3& direction, double right, double up) {
  const double length = glm::length(direction);
  const double yaw = std::atan2(direction.x, -direction.z) + right;
  const double pitch = std::clamp(std::asin(std::clamp(direction.y / length, -1.0, 1.0)) + up, -kMostPitch, kMostPitch);
  return length * glm::dvec3(std::cos(pitch) * std::sin(yaw), std::sin(pitch), -std::cos(pitch) * std::cos(yaw));
}

double tangentOf(const LookAt& view) { return std::tan(0.5 * glm::radians(view.fovDegrees)); }

} // namespace

LookAt lookAtOf(const tyndall::Camera& camera, double distance) {
  const glm::dmat4 worldFromView = glm::inverse(host::fromMat4(camera.viewFromWorld));
  const glm::dmat4 clipFromView = host::fromMat4(camera.clipFromView);
  const bool isPerspective = clipFromView[3][3] == 0;
  const double halfHeight = isPerspective ? 1 / clipFromView[1][1] : 1 / (clipFromView[1][1] * distance);
  LookAt view;
  view.eye = glm::dvec3(worldFromView[3]);
  view.target = view.eye - distance * glm::normalize(glm::dvec3(worldFromView[2]));
  const double degrees = std::clamp(glm::degrees(2 * std::atan(halfHeight)), 1.0, 170.0);
  view.fovDegrees = std::round(degrees * 1e9) / 1e9; // what a person wrote, without the rounding of matrices
  return turned(view, 0, 0);                         // which leaves out what is too steep
}

LookAt orbited(const LookAt& view, double right, double up) {
  LookAt result = view;
  result.eye = view.target - turnedDirection(view.target - view.eye, right, up);
  return result;
}

LookAt turned(const LookAt& view, double right, double up) {
  LookAt result = view;
  result.target = view.eye + turnedDirection(view.target - view.eye, right, up);
  return result;
}

LookAt panned(const LookAt& view, double right, double up) {
  const double distance = glm::length(view.target - view.eye);
  return flown(view, {right * distance, up * distance, 0});
}

LookAt zoomed(const LookAt& view, double factor) {
  const glm::dvec3 away = view.eye - view.target;
  LookAt result = view;
  result.eye = view.target + away * std::max(factor, kLeastDistance / glm::length(away));
  return result;
}

LookAt flown(const LookAt& view, const glm::dvec3& step) {
  const Axes axes = axesOf(view);
  const glm::dvec3 move = step.x * axes.right + step.y * axes.up + step.z * axes.forward;
  LookAt result = view;
  result.eye += move;
  result.target += move;
  return result;
}

LookAt framed(const LookAt& view, const host::Bounds& bounds, double aspect) {
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  const double radius = std::max(0.5 * glm::length(bounds.high - bounds.low), kLeastDistance);
  const double tangent = tangentOf(view) * std::min(1.0, aspect);
  const double distance = radius * std::sqrt(1 + 1 / (tangent * tangent)); // the ball's outline fills the view
  LookAt result = view;
  result.target = middle;
  result.eye = middle - distance * axesOf(view).forward;
  return result;
}

glm::dvec3 rayOf(const LookAt& view, double aspect, const glm::dvec2& point) {
  const Axes axes = axesOf(view);
  const double tangent = tangentOf(view);
  return glm::normalize(axes.forward + (2 * point.x - 1) * tangent * aspect * axes.right +
                        (2 * point.y - 1) * tangent * axes.up);
}

glm::dvec3 projected(const LookAt& view, double aspect, const glm::dvec3& place) {
  const Axes axes = axesOf(view);
  const glm::dvec3 to = place - view.eye;
  const double depth = glm::dot(to, axes.forward);
  const double scale = 0.5 / (tangentOf(view) * std::max(std::abs(depth), kLeastDistance));
  return {0.5 + scale / aspect * glm::dot(to, axes.right), 0.5 + scale * glm::dot(to, axes.up), depth};
}

} // namespace viewer
