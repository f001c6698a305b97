// The plane through a ray and a light: what crosses it between the two shades a stretch of the ray.
#pragma once

#include "Ray.h"
#include "TriangleBvh.h"

#include <optional>
#include <tyndall/tyndall.h>

namespace reference {

/// Coordinates (x, y) in the slice: x along the ray, y from the ray towards the light. For a directional light
/// p = origin + x v - y l with l the light's travel, so that a point shades the ray at its own x. For a point or spot
/// light y is perpendicular to the ray; with the light at (foot, height) a point shades the ray at foot + (x - foot)
/// height / (height - y).
class LightSlice {
public:
  /// For the stretch [s0, s1] of the ray, finite. Where the ray runs into the light the slice is not unique; the light
  /// is then moved aside by the square root of the rounding error.
  LightSlice(const tyndall::Light& light, const Ray& ray, double s0, double s1);

  /// The region between stretch and light.
  const PlanarRegion& region() const { return region_; }

  /// The part of the stretch in the shadow of a triangle, if any. Two triangles that share an edge give intervals whose
  /// common end is the same to the bit, so that there is neither gap nor overlap.
  std::optional<Interval> shadowOf(const TriangleBvh::Corners& corners) const;

private:
  struct Point {
    double x;
    double y;
  };
  void makeDirectional(glm::dvec3 travel);
  void makePoint(glm::dvec3 toLight);
  void shearToLight(int side, double s, double sign);
  std::optional<Interval> project(Point a, Point b) const;
  double projected(Point p) const;

  Ray ray_;
  Interval stretch_;
  bool directional_;
  PlanarRegion region_;
  glm::dvec3 xFromOffset_{0}; ///< x = dot(xFromOffset, p - origin), likewise y
  glm::dvec3 yFromOffset_{0};
  double foot_ = 0;
  double height_ = 0;
};

} // namespace reference
