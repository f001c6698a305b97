#include "optics/LowRank.h"

#include "optics/Blocks.h"
#include "optics/HeightFog.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall::optics {

namespace {

using glm::dvec3;

constexpr int kGrid = kLowRankGrid;
constexpr double kDarkShare = 0.3;       // of the distance of extinction.w, 40 optical depths: the grid ends there
constexpr double kLeastSine = 1.0 / 300; // of the greatest; nearer to the light's direction the closed form is used

// What the kernel depends on, and the grid over it. With a directional light the coordinates are the sine of beta, in
// logarithmic steps, and the distance x = s sin(beta) from the line through the eye along the light, as cubes; with a
// lamp the angles at the eye and at the lamp, in even steps.
class Kernel {
public:
  Kernel(const Frame& frame, const Light& light, const SliceTable& slices)
      : block_(frameBlock(frame, {})), light_(lightBlock(frame, light, 0, 0)),
        directional_(light.kind == LightKind::Directional) {
    toLight_ = directional_ ? -dvec3(light_.lightDirection) : dvec3(light_.lightPosition);
    distance_ = glm::length(toLight_);
    axis_ = toLight_ / std::max(distance_, 1e-300);
    end_ = farthestEnd(block_);
    const double seen = std::min(end_, kDarkShare * block_.visibleEnd);
    for (int i = 0; i < slices.slices; ++i) {
      const glm::dvec4 ends(slices.texels[static_cast<std::size_t>(i)]);
      for (const glm::dvec2 p : {glm::dvec2(ends.x, ends.y), glm::dvec2(ends.z, ends.w)})
        addAngle(p);
    }
    if (directional_) {
      if (leastCosine_ < 0 && mostCosine_ > 0) highest_ = 1; // between the ends of a slice
      lowest_ = std::log(std::max(lowest_, kLeastSine * highest_));
      extent_ = seen * highest_;
      highest_ = std::log(highest_);
    } else {
      double last = 0;
      for (int i = 0; i < kGrid; ++i)
        last = std::max(last, lampAngle(rayAt(i), seen));
      if (light.kind == LightKind::Spot) { // no light outside the cone
        const double cosine = glm::dot(-axis_, dvec3(light_.lightDirection));
        const double toEye = std::acos(glm::clamp(cosine, -1.0, 1.0));
        begin_ = std::max(toEye - light.outerConeAngle, 0.0);
        last = std::min(last, toEye + light.outerConeAngle);
      }
      extent_ = last - begin_;
    }
    highest_ = std::max(highest_, lowest_ + 1e-6);
  }

  // True without angles that float32 resolves in the shader.
  bool isEmpty() const {
    constexpr double kLeastAngle = 1e-4;
    const bool narrow = directional_ ? std::exp(highest_) < kLeastAngle : extent_ < kLeastAngle;
    return narrow || !std::isfinite(lowest_) || !(extent_ > 0) || !std::isfinite(extent_) || !(distance_ > 0);
  }

  double rayAt(int i) const {
    const double at = lowest_ + (highest_ - lowest_) * i / (kGrid - 1);
    return directional_ ? std::exp(at) : at;
  }
  double lightAt(int j) const {
    const double t = static_cast<double>(j) / (kGrid - 1);
    return begin_ + extent_ * (directional_ ? t * t * t : t);
  }

  // Integrand over x or gamma, less its factor 1 / sin(beta) or 1 / h; of a directional light less its phase function,
  // too. Behind the farthest point it stays what it is there.
  dvec3 at(double ray, double place) const {
    const dvec3 sigma(block_.extinction);
    if (directional_) return glm::exp(-sigma * std::min(place / ray, end_));
    const double gamma = std::min(place, lampAngle(ray, end_)), theta = ray + gamma;
    const double sine = std::max(std::sin(theta), 1e-12);
    const double path = distance_ * (std::sin(gamma) + std::sin(ray)) / sine;
    return phaseAt(std::cos(theta)) * glm::exp(-sigma * path);
  }

  // Each ray counts by the pixels that share it and its factor in the picture; each light ray by its share of the sum.
  double rowWeight(int i) const {
    if (!directional_) return 1 / std::sqrt(std::max(std::sin(rayAt(i)), 1e-3));
    const double cosine = std::sqrt(std::max(1 - rayAt(i) * rayAt(i), 0.0));
    const dvec3 towards = phaseAt(cosine), away = phaseAt(-cosine);
    return std::max({towards.x, towards.y, towards.z, away.x, away.y, away.z});
  }
  double columnWeight(int j) const {
    return std::sqrt(0.5 * (lightAt(std::min(j + 1, kGrid - 1)) - lightAt(std::max(j - 1, 0))));
  }

  // A spot's falloff towards a slice's plane at the angle gamma at the lamp.
  double falloff(const dvec3& across, double gamma) const {
    const double cosine = glm::dot(dvec3(light_.lightDirection), across * std::sin(gamma) - axis_ * std::cos(gamma));
    const double outer = light_.outerCosine, scale = light_.falloffScale;
    if (scale == 0) return cosine >= outer ? 1 : 0;
    const double share = glm::clamp((cosine - outer) * scale, 0.0, 1.0);
    return share * share;
  }
  // The unit vector across the axis in the plane through a window position.
  dvec3 acrossAt(const glm::dvec2& window) const {
    const dvec3 ray = directionAt(window), across = ray - axis_ * glm::dot(axis_, ray);
    const double length = glm::length(across);
    return length > 0 ? across / length : dvec3(0);
  }

  void setCoordinates(LowRankTable& table) const {
    table.rayBegin = static_cast<float>(lowest_);
    table.rayScale = static_cast<float>((kGrid - 1) / (highest_ - lowest_));
    table.lightBegin = static_cast<float>(begin_);
    table.lightExtent = static_cast<float>(extent_);
  }

private:
  dvec3 directionAt(const glm::dvec2& window) const {
    const glm::dvec2 p = window - 0.5 * glm::dvec2(block_.frameSize);
    if (block_.isOrthographic != 0) return glm::normalize(-dvec3(block_.nearStep));
    return glm::normalize(dvec3(block_.farPoint[0]) + p.x * dvec3(block_.farPoint[1]) +
                          p.y * dvec3(block_.farPoint[2]));
  }

  void addAngle(const glm::dvec2& window) {
    const dvec3 ray = directionAt(window);
    const double sine = glm::length(glm::cross(axis_, ray)), cosine = glm::dot(axis_, ray);
    const double value = directional_ ? sine : std::atan2(sine, cosine);
    leastCosine_ = std::min(leastCosine_, cosine);
    mostCosine_ = std::max(mostCosine_, cosine);
    lowest_ = std::min(lowest_, value);
    highest_ = std::max(highest_, value);
  }

  // The angle at the lamp between the eye and the point at s.
  double lampAngle(double beta, double s) const {
    return std::atan2(s * std::sin(beta), distance_ - s * std::cos(beta));
  }

  dvec3 phaseAt(double cosine) const {
    dvec3 sum(0);
    for (int k = 0; k < block_.constituentCount; ++k) {
      const glm::dvec4 shape(block_.phaseShape[k]);
      const double d = shape.x + shape.y * (shape.w > 0 ? 1 - cosine : 1 + cosine);
      sum += dvec3(block_.phaseWeight[k]) * ((1 + shape.z * cosine * cosine) / (d * std::sqrt(d)));
    }
    return sum;
  }

  blocks::FrameBlock block_;
  blocks::LightBlock light_;
  bool directional_;
  dvec3 toLight_{0}, axis_{0};
  double distance_ = 0, end_ = 0;
  double begin_ = 0, extent_ = 0;            // of the light ray's coordinate
  double lowest_ = 1e300, highest_ = -1e300; // of the ray's coordinate
  double leastCosine_ = 1, mostCosine_ = -1;
};

// Prefix sums of each term over gamma, dimmed by `falloff`, in cells that are summed in parts, and the terms
// themselves.
template <typename Falloff>
void addSet(const Kernel& kernel, const std::vector<glm::dvec3>& terms, int set, const Falloff& falloff,
            LowRankTable& table) {
  constexpr int kParts = 4;
  const std::size_t count = terms.size() / kGrid;
  for (std::size_t term = 0; term < count; ++term) {
    dvec3 sum(0);
    const auto store = [&](std::size_t row, const dvec3& value) {
      table.lights[row * static_cast<std::size_t>(table.sets) + static_cast<std::size_t>(set)] = glm::vec4(value, 0);
    };
    for (int j = 0; j < kGrid; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const dvec3 here = terms[term * kGrid + at];
      store(2 * term * kGrid + at, sum);
      store((2 * term + 1) * kGrid + at, here * falloff(kernel.lightAt(j)));
      if (j + 1 == kGrid) break;
      const double begin = kernel.lightAt(j), length = kernel.lightAt(j + 1) - begin;
      for (int part = 0; part < kParts; ++part) {
        const double f = (part + 0.5) / kParts;
        sum += glm::mix(here, terms[term * kGrid + at + 1], f) * (falloff(begin + f * length) * length / kParts);
      }
    }
  }
}

} // namespace

std::optional<LowRankFactors> factorise(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rowWeights,
                                        const Eigen::VectorXd& columnWeights, int terms) {
  const Eigen::MatrixXd weighted = rowWeights.asDiagonal() * matrix * columnWeights.asDiagonal();
  if (!weighted.allFinite()) return std::nullopt;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(weighted, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd values = svd.singularValues().head(terms);
  return LowRankFactors{rowWeights.cwiseInverse().asDiagonal() * svd.matrixU().leftCols(terms) * values.asDiagonal(),
                        svd.matrixV().leftCols(terms).transpose() * columnWeights.cwiseInverse().asDiagonal()};
}

void LowRankTable::describe(blocks::EpipolarBlock& block) const {
  block.lowRankTerms = terms;
  block.lowRankRayBegin = rayBegin;
  block.lowRankRayScale = rayScale;
  block.lowRankLightBegin = lightBegin;
  block.lowRankLightExtent = lightExtent;
  block.lowRankPerSlice = sets > 1 ? 1 : 0;
}

std::optional<LowRankTable> makeLowRank(const Frame& frame, const Light& light, const SliceTable& slices) {
  const bool directional = light.kind == LightKind::Directional;
  if ((directional && light.boundary.enabled) || isLayered(frame.medium)) return std::nullopt;
  if (!directional && frameBlock(frame, {}).isOrthographic != 0) return std::nullopt;
  const Kernel kernel(frame, light, slices);
  if (kernel.isEmpty()) return std::nullopt;

  const int terms = frame.settings.lowRankTerms;
  LowRankTable table;
  table.sets = light.kind == LightKind::Spot ? slices.slices : 1;
  table.terms = terms;
  kernel.setCoordinates(table);
  const auto size = static_cast<std::size_t>(terms) * kGrid;
  table.rays.resize(size);
  table.lights.resize(2 * size * static_cast<std::size_t>(table.sets));
  std::vector<dvec3> lights(size);

  Eigen::VectorXd rowWeights(kGrid), columnWeights(kGrid);
  for (int i = 0; i < kGrid; ++i) {
    rowWeights[i] = kernel.rowWeight(i);
    columnWeights[i] = kernel.columnWeight(i);
  }
  Eigen::MatrixXd channels[3] = {Eigen::MatrixXd(kGrid, kGrid), Eigen::MatrixXd(kGrid, kGrid),
                                 Eigen::MatrixXd(kGrid, kGrid)};
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const dvec3 value = kernel.at(kernel.rayAt(i), kernel.lightAt(j));
      for (int c = 0; c < 3; ++c)
        channels[c](i, j) = value[c];
    }
  const bool grey = isMonochrome(frame.medium);
  std::optional<LowRankFactors> factors;
  for (int c = 0; c < 3; ++c) {
    if (c == 0 || !grey) factors = factorise(channels[c], rowWeights, columnWeights, terms);
    if (!factors) return std::nullopt;
    for (int term = 0; term < terms; ++term)
      for (int i = 0; i < kGrid; ++i) {
        const auto at = static_cast<std::size_t>(term * kGrid + i);
        table.rays[at][c] = static_cast<float>(factors->rays(i, term));
        lights[at][c] = factors->lights(term, i);
      }
  }
  if (light.kind != LightKind::Spot) {
    addSet(kernel, lights, 0, [](double) { return 1.0; }, table);
    return table;
  }
  for (int slice = 0; slice < slices.slices; ++slice) {
    const glm::dvec4 ends(slices.texels[static_cast<std::size_t>(slice)]);
    const dvec3 across = kernel.acrossAt({ends.z, ends.w});
    addSet(kernel, lights, slice, [&](double gamma) { return kernel.falloff(across, gamma); }, table);
  }
  return table;
}

} // namespace tyndall::optics
