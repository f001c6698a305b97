// The answer of the geometry itself: rays against triangles, light integrated between exact shadow transitions.
//
// A pixel's ray ends at the first opaque triangle between the camera's near and far plane (Embree, the distance refined
// in double). All triangles that cross the plane region between ray and light shade an interval of the ray each; opaque
// ones make it dark, each glass surface multiplies the light by its tint.
#pragma once

#include "Ray.h"
#include "TriangleBvh.h"

#include <memory>
#include <scene/Scene.h>
#include <tyndall/tyndall.h>

namespace reference {

struct Triangle {
  glm::dvec3 a{0};
  glm::dvec3 b{0};
  glm::dvec3 c{0};
  bool glass = false;
  Rgb tint{1}; ///< of glass: what passes of the light
};

/// The triangles of a posed scene in world space that are not unlit. Glass: Material::isGlass, tint = base colour
/// factor
/// * transmission factor; of a blended material so much as alpha covers, and the rest is clear. Textures are not looked
/// at: a masked material is opaque unless its alpha factor is below the cutoff; then it is left out.
std::vector<Triangle> trianglesOf(const host::Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

struct SceneView {
  tyndall::Camera camera;
  std::vector<tyndall::Light> lights; ///< shadow and glass maps are not looked at
  tyndall::Medium medium;
  tyndall::Ambient ambient; ///< without its texture
  int width = 0;
  int height = 0;
};

/// A stretch of a ray that the light reaches, through glass of this tint.
struct LitSpan {
  double begin = 0;
  double end = 0;
  Rgb tint{1};
};

class SceneExact {
public:
  explicit SceneExact(const std::vector<Triangle>& triangles);

  /// All pixels, one ray through each pixel's centre.
  ImageAnswer render(const SceneView& view) const;

  /// Some pixels, in the order given.
  std::vector<PixelAnswer> render(const SceneView& view, const std::vector<glm::ivec2>& pixels) const;

  /// The distance of the first opaque triangle in [nearest, farthest] of the ray; infinite if there is none.
  double firstHit(const Ray& ray, double nearest = 0, double farthest = kInfinity) const;

  /// The stretches of [s0, s1] that the light reaches, in order; [s0, s1] is finite.
  std::vector<LitSpan> litSpans(const Ray& ray, const tyndall::Light& light, double s0, double s1) const;

  /// What reaches a point of the light: 0 behind an opaque triangle, else the product of the tints of all glass on the
  /// way. Traced by Embree in single precision, as a check of litSpans.
  Rgb visibilityAt(const glm::dvec3& point, const tyndall::Light& light) const;

private:
  /// One kind of triangles for both questions: rays (Embree) and planar regions.
  struct Part {
    std::vector<TriangleBvh::Corners> corners;
    std::vector<Rgb> tints;
    ScenePointer embree;
    std::unique_ptr<TriangleBvh> bvh;
  };

  void build(Part& part) const;
  RTCRay embreeRay(const Ray& ray, double nearest, double farthest) const;
  PixelAnswer pixel(const SceneView& view, const class CameraRays& rays, int x, int y) const;

  DevicePointer device_;
  glm::dvec3 centre_{0}; ///< Embree's floats are relative to it
  Part opaque_;
  Part glass_;
};

} // namespace reference
