#include "LightSlice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reference {
namespace {

/// The sine of the angle under which ray and light are told apart: sqrt(2^-52), the best balance between the error
/// of moving the light and that of dividing by the sine.
constexpr double kSmallestSine = 1.5e-8;

glm::dvec3 anyPerpendicular(const glm::dvec3& v) {
  const glm::dvec3 axis = std::abs(v.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, axis));
}

} // namespace

LightSlice::LightSlice(const tyndall::Light& light, const Ray& ray, double s0, double s1)
    : ray_(ray), stretch_{s0, s1}, directional_(light.kind == tyndall::LightKind::Directional) {
  region_.origin = ray.origin;
  if (directional_)
    makeDirectional(glm::normalize(toVec3(light.direction)));
  else
    makePoint(toVec3(light.position) - ray.origin);
}

void LightSlice::makeDirectional(glm::dvec3 travel) {
  const glm::dvec3& v = ray_.direction;
  if (glm::length(glm::cross(v, travel)) < kSmallestSine)
    travel = glm::normalize(travel + kSmallestSine * anyPerpendicular(v));
  region_.planeNormal = glm::normalize(glm::cross(v, travel));
  const glm::dvec3 up = glm::normalize(glm::cross(v, region_.planeNormal)); // away from the light's travel: towards it
  const glm::dvec3 across = glm::cross(region_.planeNormal, travel);        // in the plane, perpendicular to travel
  xFromOffset_ = across / glm::dot(v, across);
  yFromOffset_ = up / glm::dot(-travel, up);
  const double length = glm::length(xFromOffset_);
  region_.sides[0] = {up, 0};
  region_.sides[1] = {xFromOffset_ / length, stretch_.begin / length};
  region_.sides[2] = {-xFromOffset_ / length, -stretch_.end / length};
}

void LightSlice::makePoint(glm::dvec3 toLight) {
  const glm::dvec3& v = ray_.direction;
  if (glm::length(glm::cross(v, toLight)) < kSmallestSine * glm::length(toLight))
    toLight += kSmallestSine * glm::length(toLight) * anyPerpendicular(v);
  foot_ = glm::dot(toLight, v);
  region_.planeNormal = glm::normalize(glm::cross(v, toLight));
  const glm::dvec3 up = glm::normalize(glm::cross(region_.planeNormal, v));
  height_ = glm::dot(toLight, up);
  xFromOffset_ = v;
  yFromOffset_ = up;
  region_.sides[0] = {up, 0};
  shearToLight(1, stretch_.begin, 1);
  shearToLight(2, stretch_.end, -1);
}

/// The half space at the line from (s, 0) to the light: height (x - s) + (s - foot) y has the given sign.
void LightSlice::shearToLight(int side, double s, double sign) {
  const double length = sign * std::hypot(height_, s - foot_);
  region_.sides[static_cast<std::size_t>(side)] = {(height_ * xFromOffset_ + (s - foot_) * yFromOffset_) / length,
                                                   height_ * s / length};
}

std::optional<Interval> LightSlice::shadowOf(const TriangleBvh::Corners& corners) const {
  std::array<glm::dvec3, 3> offset;
  std::array<double, 3> distance;
  for (std::size_t i = 0; i < 3; ++i) {
    offset[i] = corners[i] - ray_.origin;
    distance[i] = glm::dot(region_.planeNormal, offset[i]);
  }
  // A corner in the plane counts as above it, for every triangle that has it. Edges are cut from below to above.
  std::array<Point, 2> cut{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t below = i, above = (i + 1) % 3;
    if ((distance[below] < 0) == (distance[above] < 0)) continue;
    if (distance[above] < 0) std::swap(below, above);
    const double f = distance[below] / (distance[below] - distance[above]);
    const glm::dvec3 p = offset[below] + f * (offset[above] - offset[below]);
    cut[count++] = {glm::dot(xFromOffset_, p), glm::dot(yFromOffset_, p)};
  }
  if (count < 2) return std::nullopt;
  return project(cut[0], cut[1]);
}

double LightSlice::projected(Point p) const {
  if (directional_) return p.x;
  const double left = height_ - p.y;
  if (left > 0) return foot_ + (p.x - foot_) * height_ / left;
  return p.x >= foot_ ? kInfinity : -kInfinity;
}

std::optional<Interval> LightSlice::project(Point a, Point b) const {
  if (a.y > b.y) std::swap(a, b);
  if (b.y <= 0 || (!directional_ && a.y >= height_)) return std::nullopt;
  const auto cutAt = [&](double y) { return Point{a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), y}; };
  const Point low = a.y < 0 ? cutAt(0) : a;
  const Point high = !directional_ && b.y > height_ ? cutAt(height_) : b;
  Interval shadow{projected(low), projected(high)};
  if (shadow.begin > shadow.end) std::swap(shadow.begin, shadow.end);
  shadow = {std::max(shadow.begin, stretch_.begin), std::min(shadow.end, stretch_.end)};
  if (shadow.begin >= shadow.end) return std::nullopt;
  return shadow;
}

} // namespace reference
