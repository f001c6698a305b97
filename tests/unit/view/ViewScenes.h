// Small scenes and random numbers for the tests of views.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <scene/Scene.h>
#include <vector>

namespace tests {

using Pose = std::vector<glm::dmat4>;

/// Even numbers from fixed seeds, the same everywhere.
class Dice {
public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  glm::dvec3 inBox(const glm::dvec3& low, const glm::dvec3& high);
  glm::dvec3 direction(); ///< unit, even over the sphere

private:
  std::mt19937 engine_;
};

/// One node at the origin with one mesh; three corners a triangle.
host::Scene sceneOf(const std::vector<glm::vec3>& corners);

/// Triangles of about `size` scattered through a box.
host::Scene scatteredTriangles(std::uint32_t seed, int count, const glm::dvec3& low, const glm::dvec3& high,
                               double size);

/// The two triangles of a parallelogram.
std::vector<glm::vec3> quad(const glm::vec3& corner, const glm::vec3& side, const glm::vec3& otherSide);

/// The twelve triangles of a box, seen from outside in front.
std::vector<glm::vec3> box(const glm::vec3& low, const glm::vec3& high);

/// A pose that leaves every node of a scene where its corners are.
Pose restPose(const host::Scene& scene);

} // namespace tests
