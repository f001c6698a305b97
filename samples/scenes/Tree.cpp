#include "Tree.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

glm::dvec3 inAnyDirection(Random& random) {
  const double y = random.between(-1, 1);
  const double angle = random.between(0, glm::two_pi<double>());
  const double ring = std::sqrt(1 - y * y);
  return {ring * std::cos(angle), y, ring * std::sin(angle)};
}

/// The point at t in [0, 1] of a path.
glm::dvec3 along(const std::vector<glm::dvec3>& path, double t) {
  const double at = t * static_cast<double>(path.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), path.size() - 2);
  return glm::mix(path[i], path[i + 1], at - static_cast<double>(i));
}

/// A path that starts in a direction, wanders, and bends upwards by `lift` a step.
std::vector<glm::dvec3> growth(const glm::dvec3& start, const glm::dvec3& direction, double length, int steps,
                               double wander, double lift, Random& random) {
  std::vector<glm::dvec3> path{start};
  glm::dvec3 heading = glm::normalize(direction);
  for (int i = 0; i < steps; ++i) {
    heading = glm::normalize(heading + wander * inAnyDirection(random) + glm::dvec3(0, lift, 0));
    path.push_back(path.back() + heading * (length / steps));
  }
  return path;
}

std::vector<double> taper(std::size_t count, double from, double to) {
  std::vector<double> radii;
  radii.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    radii.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1));
  return radii;
}

void twig(MeshBuilder& mesh, const Foliage& foliage, const TreeShape& shape, const glm::dvec3& start,
          const glm::dvec3& direction, double length, Random& random) {
  for (int i = 0; i < shape.leavesPerTwig; ++i) {
    const double where = length * random.between(0.1, 1);
    const glm::dvec3 stalk = start + direction * where + 0.3 * inAnyDirection(random);
    const glm::dvec3 out = glm::normalize(direction * 0.6 + inAnyDirection(random) + glm::dvec3(0, -0.35, 0));
    const glm::dvec3 up = glm::normalize(glm::dvec3(0, 1, 0) + 0.8 * inAnyDirection(random));
    mesh.material(foliage.leaves[static_cast<std::size_t>(random.below(static_cast<int>(foliage.leaves.size())))]);
    leaf(mesh, stalk, out, glm::cross(out, up), shape.leafLength * random.between(0.7, 1.2));
  }
}

} // namespace

void leaf(MeshBuilder& mesh, const glm::dvec3& stalk, const glm::dvec3& along, const glm::dvec3& across,
          double length) {
  const glm::dvec3 side = glm::normalize(across);
  const glm::dvec3 up = glm::normalize(glm::cross(side, along));
  const glm::dvec3 middle = stalk + along * (0.45 * length);
  const glm::dvec3 tip = stalk + along * length - up * (0.12 * length);
  const glm::dvec3 fold = up * (0.1 * length);
  mesh.polygon({stalk, middle + side * (0.3 * length) + fold, tip});
  mesh.polygon({stalk, tip, middle - side * (0.3 * length) + fold});
}

void tree(MeshBuilder& mesh, const Foliage& foliage, const TreeShape& shape, Random& random) {
  const double leanX = random.between(-0.05, 0.05);
  const double leanZ = random.between(-0.05, 0.05);
  auto trunk = growth({0, -0.4, 0}, {leanX, 1, leanZ}, shape.height, 9, 0.05, 0.05, random);
  trunk.insert(trunk.begin() + 1, along(trunk, 0.06));
  auto radii = taper(trunk.size(), shape.radius, 0.12 * shape.radius);
  radii[0] *= 1.9;
  radii[1] *= 1.2;
  mesh.material(foliage.bark).tube(trunk, radii, 9);
  double turn = random.between(0, glm::two_pi<double>());
  for (int i = 0; i < shape.branches; ++i) {
    const double t = (i + random.unit()) / shape.branches;
    const double at = shape.bare + (0.98 - shape.bare) * t;
    turn += 2.399963229728653 + random.between(-0.3, 0.3);
    const glm::dvec3 out(std::cos(turn), random.between(0.05, 0.35) + 0.7 * t, std::sin(turn));
    const double length = shape.crown * (1 - 0.72 * t) * random.between(0.75, 1.15);
    const auto branch = growth(along(trunk, at), out, length, 3, 0.16, 0.04, random);
    const double thick = shape.radius * (0.34 - 0.24 * t);
    mesh.material(foliage.bark).tube(branch, taper(branch.size(), thick, 0.012), 4);
    for (int k = 0; k < shape.twigs; ++k) {
      const double where = random.between(0.25, 1);
      const glm::dvec3 direction = glm::normalize(out + 0.9 * inAnyDirection(random));
      twig(mesh, foliage, shape, along(branch, where), direction, random.between(0.5, 1.2), random);
    }
  }
}

void fern(MeshBuilder& mesh, int material, const glm::dvec3& root, double size, Random& random) {
  constexpr int kFronds = 8;
  constexpr int kPairs = 6;
  mesh.material(material);
  const double turn = random.between(0, glm::two_pi<double>());
  for (int i = 0; i < kFronds; ++i) {
    const double angle = turn + glm::two_pi<double>() * (i + random.between(-0.2, 0.2)) / kFronds;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    const glm::dvec3 side(-out.z, 0, out.x);
    const auto rib = [&](double t) { return root + size * (out * t + glm::dvec3(0, 0.75 * t - 0.85 * t * t, 0)); };
    for (int k = 0; k < kPairs; ++k) {
      const double t = (k + 0.6) / kPairs;
      const glm::dvec3 a = rib(t - 0.08);
      const glm::dvec3 b = rib(t + 0.08);
      const double reach = size * 0.26 * (1.1 - t);
      const glm::dvec3 droop(0, -0.25 * reach, 0);
      const glm::dvec3 lean = (b - a) * 0.5;
      mesh.polygon({a, b + side * reach * 1.0 + droop + lean, b});
      mesh.polygon({a, b, b - side * reach + droop + lean});
    }
  }
}

} // namespace scenes
