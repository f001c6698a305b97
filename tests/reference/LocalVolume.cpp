#include "reference/LocalVolume.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>

namespace reference {

namespace {

using Shape = tyndall::AvsmVolume::Shape;

double cleaned(float value) { return value > 0 ? std::min(static_cast<double>(value), 1e18) : 0; }

double trilinear(const DensityGrid& grid, const glm::dvec3& place) {
  const glm::dvec3 at = (0.5 * place + 0.5) * glm::dvec3(grid.size) - 0.5, low = glm::floor(at), share = at - low;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    std::size_t index = 0;
    double weight = 1;
    for (int axis = 2; axis >= 0; --axis) {
      const int step = (corner >> axis) & 1;
      const int texel = std::clamp(static_cast<int>(low[axis]) + step, 0, grid.size[axis] - 1);
      index = index * static_cast<std::size_t>(grid.size[axis]) + static_cast<std::size_t>(texel);
      weight *= step == 1 ? share[axis] : 1 - share[axis];
    }
    sum += weight * cleaned(grid.values[index]);
  }
  return sum;
}

// Hermite's cubic from 0 at the border to 1.
double faded(double distance, double fade) {
  const double t = std::clamp(distance / fade, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

constexpr double kNodes[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeights[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

} // namespace

double densityAt(const tyndall::AvsmVolume& volume, const DensityGrid& grid, const glm::dvec3& place) {
  const glm::dvec3 size = glm::abs(place);
  const bool isSphere = volume.shape == Shape::Sphere;
  if (isSphere ? glm::length(place) > 1 : std::max({size.x, size.y, size.z}) > 1) return 0;
  double density = grid.size.x > 0 ? trilinear(grid, place) : 1;
  if (volume.fade > 0) {
    if (isSphere) density *= faded(1 - glm::length(place), volume.fade);
    for (int axis = 0; axis < 3 && !isSphere; ++axis)
      density *= faded(1 - size[axis], volume.fade);
  }
  return density;
}

double opticalDepth(const tyndall::AvsmVolume& volume, const DensityGrid& grid, const glm::dvec3& from,
                    const glm::dvec3& to) {
  const glm::dmat4 volumeFromWorld = glm::inverse(toMat4(volume.worldFromVolume));
  const glm::dvec3 a(volumeFromWorld * glm::dvec4(from, 1)), d = glm::dvec3(volumeFromWorld * glm::dvec4(to, 1)) - a;
  std::vector<double> cuts = {0, 1};
  const auto addPlane = [&](int axis, double place) {
    const double at = (place - a[axis]) / d[axis];
    if (at > 0 && at < 1) cuts.push_back(at);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) continue;
    for (const double side : {-1.0, 1.0}) {
      addPlane(axis, side);
      addPlane(axis, side * (1 - volume.fade));
    }
    for (int i = 0; i < grid.size[axis]; ++i)
      addPlane(axis, 2 * (i + 0.5) / grid.size[axis] - 1);
  }
  if (volume.shape == Shape::Sphere) // the border, where the fade ends, and, between, what is no polynomial in pieces
    for (const double radius : {1.0, 1 - volume.fade}) {
      const double square = glm::dot(d, d), b = glm::dot(a, d),
                   root = b * b - square * (glm::dot(a, a) - radius * radius);
      for (int i = -8; i <= 8 && root > 0; ++i) {
        const double at = (-b + i / 8.0 * std::sqrt(root)) / square;
        if (at > 0 && at < 1) cuts.push_back(at);
      }
    }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double half = 0.5 * (cuts[i] - cuts[i - 1]), middle = 0.5 * (cuts[i] + cuts[i - 1]);
    for (int k = 0; k < 4 && half > 0; ++k)
      for (const double side : {-1.0, 1.0})
        sum += half * kWeights[k] * densityAt(volume, grid, a + (middle + side * kNodes[k] * half) * d);
  }
  return volume.extinction * glm::length(to - from) * sum;
}

} // namespace reference
