// Solids and sheets from a few numbers. Faces wind counter-clockwise seen from outside.
#pragma once

#include "Scene.h"
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace scenes {

class MeshBuilder {
public:
  /// Builds what stands still.
  explicit MeshBuilder(Scene& scene) : surfaces_(scene.surfaces), grid_(scene.grid) {}
  /// Builds a body in its own coordinates, of the materials that the scene has by now.
  MeshBuilder(const Scene& scene, Body& body) : surfaces_(body.surfaces), grid_(scene.grid) {
    body.surfaces.resize(scene.materials.size());
  }

  /// The material of what follows.
  MeshBuilder& material(int index);
  /// Where what follows stands; mirrors are allowed and keep the winding outward.
  MeshBuilder& frame(const glm::dmat4& worldFromLocal);

  std::uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal);
  /// With a colour of its own, 0 to 1, that the material's is multiplied by: of all vertices of a material or none.
  std::uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& colour);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  /// A flat convex polygon; polygons without area are left out.
  void polygon(const std::vector<glm::dvec3>& corners);
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  void box(const glm::dvec3& low, const glm::dvec3& high);
  /// A prism over a convex counter-clockwise outline in xy, from z = low to z = high.
  void prism(const std::vector<glm::dvec2>& outline, double low, double high);
  /// A smooth sheet over [0, 1]^2, front where du x dv points.
  void sheet(int columns, int rows, const std::function<glm::dvec3(double, double)>& point);
  /// A solid of revolution about y; the profile holds (radius, height), going upwards on its outside.
  void lathe(const std::vector<glm::dvec2>& profile, int sides);
  /// A round pipe along a path with a radius a point.
  void tube(const std::vector<glm::dvec3>& path, const std::vector<double>& radii, int sides);
  void tube(const std::vector<glm::dvec3>& path, double radius, int sides);
  /// A bar of rectangular section along a path in the plane across `axis`: `width` in that plane, `depth` along the
  /// axis.
  void bar(const std::vector<glm::dvec3>& path, const glm::dvec3& axis, double width, double depth,
           bool closed = false);
  /// A ring-shaped pipe about y.
  void torus(const glm::dvec3& centre, double radius, double thickness, int sides, int sections);
  void sphere(const glm::dvec3& centre, double radius, int sides);
  /// A boulder: a sphere dented by noise.
  void boulder(const glm::dvec3& centre, const glm::dvec3& radii, double roughness, double seed, int sides);

private:
  std::vector<Surface>& surfaces_;
  double grid_;
  int material_ = 0;
  glm::dmat4 worldFromLocal_{1};
  glm::dmat3 worldFromLocalNormal_{1};
  bool mirrored_ = false;
};

/// The number of triangles of a scene, bodies included.
std::size_t triangleCount(const Scene& scene);

/// worldFromLocal of a frame at `origin` whose y and z axes lie along `up` and, as far as that allows, `front`.
glm::dmat4 frameAt(const glm::dvec3& origin, const glm::dvec3& up, const glm::dvec3& front);

} // namespace scenes
