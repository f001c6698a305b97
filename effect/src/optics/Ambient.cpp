#include "optics/Ambient.h"

#include "optics/Blocks.h"
#include "optics/HeightFog.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>

namespace tyndall::optics {

namespace {

using glm::dvec3;

constexpr std::size_t kTerms = AMBIENT_TERMS;
constexpr double kBrightest = 1e37; // float32 holds the sum of so many terms
// Of the harmonics, in the order of Ambient::harmonics, which is that of the terms of AmbientBlock.
constexpr std::array<double, kTerms> kFactors = {0.28209479177387814, 0.4886025119029199, 0.4886025119029199,
                                                 0.4886025119029199,  1.0925484305920792, 1.0925484305920792,
                                                 0.31539156525252005, 1.0925484305920792, 0.5462742152960396};
constexpr std::array<std::size_t, kTerms> kDegrees = {0, 1, 1, 1, 2, 2, 2, 2, 2};

using Terms = std::array<dvec3, kTerms>;

// Of what one constituent scatters.
Terms scatteredBy(const Constituent& constituent, const Ambient& ambient) {
  const std::array<double, 3> moments = phaseMoments(constituent);
  const dvec3 scattering(toGlm(constituent.scattering));
  Terms terms;
  for (std::size_t i = 0; i < kTerms; ++i)
    terms[i] = scattering * (kFactors[i] * moments[kDegrees[i]]) * dvec3(toGlm(ambient.harmonics[i]));
  terms[0] += scattering * dvec3(toGlm(ambient.radiance));
  return terms;
}

dvec3 at(const Terms& terms, const dvec3& d) {
  const std::array<double, kTerms> values = {
      1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
  dvec3 sum(0);
  for (std::size_t i = 0; i < kTerms; ++i)
    sum += values[i] * terms[i];
  return sum;
}

} // namespace

bool isLit(const Ambient& ambient) {
  const auto isBlack = [](const Rgb& colour) { return colour == Rgb{0, 0, 0}; };
  return !isBlack(ambient.radiance) || !std::all_of(ambient.harmonics.begin(), ambient.harmonics.end(), isBlack);
}

std::array<double, 3> phaseMoments(const Constituent& constituent) {
  const double g = constituent.g, g2 = g * g;
  switch (constituent.phase) {
  case Phase::Isotropic:
    return {1, 0, 0};
  case Phase::Rayleigh:
    return {1, 0, 0.1};
  case Phase::HenyeyGreenstein:
    return {1, g, g2};
  case Phase::CornetteShanks: {
    // 3 / (2 (2 + g^2)) times Henyey and Greenstein's, and those times cos^2.
    const double first = g + (3 * g + 2 * g * g2) / 5, second = g2 + 12 * g2 * g2 / 35 + 11 * g2 / 21 + 2.0 / 15;
    const double norm = 1.5 / (2 + g2);
    return {1, norm * first, norm * second};
  }
  }
  return {1, 0, 0};
}

blocks::AmbientBlock ambientBlock(const Frame& frame, const glm::ivec2& occlusionSize) {
  blocks::AmbientBlock block{};
  std::array<Terms, 1 + MAX_HEIGHT_LAYERS> groups{};
  const bool layered = isLayered(frame.medium);
  for (const Constituent& constituent : frame.medium.constituents) {
    const Terms terms = scatteredBy(constituent, frame.ambient);
    Terms& group = groups[layered ? static_cast<std::size_t>(constituent.layer + 1) : 0];
    for (std::size_t i = 0; i < kTerms; ++i)
      group[i] += terms[i];
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t i = 0; i < kTerms; ++i)
      block.ambientHarmonics[g * kTerms + i] = glm::dvec4(glm::clamp(groups[g][i], -kBrightest, kBrightest), 0);
  block.occlusionSize = occlusionSize;
  return block;
}

double brightestAmbient(const Frame& frame) {
  const dvec3 way = longestWay(frame.medium, cameraOrigin(frame.camera), 1e300);
  dvec3 most(0); // none of the terms' polynomials is more than 2
  for (const Constituent& constituent : frame.medium.constituents)
    for (const dvec3& term : scatteredBy(constituent, frame.ambient))
      most += 2.0 * glm::abs(term);
  double brightest = 0;
  for (int c = 0; c < 3; ++c)
    if (most[c] > 0) brightest = std::max(brightest, most[c] * way[c]);
  return brightest;
}

// In directions all around: what degree 2 leaves out between them is less than 2 %.
double leastAmbient(const Frame& frame) {
  constexpr int kSteps = 24;
  double least = 0, most = 0;
  for (const Constituent& constituent : frame.medium.constituents) {
    const Terms terms = scatteredBy(constituent, frame.ambient);
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j < 2 * kSteps; ++j) {
        const double polar = 3.141592653589793 * i / kSteps, around = 3.141592653589793 * j / kSteps;
        const dvec3 value =
            at(terms, {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)});
        for (int c = 0; c < 3; ++c) {
          least = std::min(least, value[c]);
          most = std::max(most, std::abs(value[c]));
        }
      }
  }
  return most > 0 ? least / most : 0;
}

} // namespace tyndall::optics
