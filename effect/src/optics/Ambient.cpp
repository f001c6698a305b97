#include "optics/Ambient.h"

#include "optics/Blocks.h"
#include "optics/EyeLight.h"
#include "optics/HeightFog.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace tyndall::optics {

namespace {

using glm::dvec3;

constexpr std::size_t kTerms = AMBIENT_TERMS;
constexpr double kBrightest = 3e38; // float32 holds it
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

// Of what is the same everywhere, of what follows each layer, and of what fog before the eye takes.
using Groups = std::array<Terms, 2 + MAX_HEIGHT_LAYERS>;

Groups groupsOf(const Frame& frame) {
  Groups groups{};
  const bool layered = isLayered(frame.medium);
  for (const Constituent& constituent : frame.medium.constituents) {
    const Terms terms = scatteredBy(constituent, frame.ambient);
    Terms& group = groups[layered ? static_cast<std::size_t>(constituent.layer + 1) : 0];
    for (std::size_t i = 0; i < kTerms; ++i)
      group[i] += terms[i];
  }
  if (isFogLit(frame)) groups.back() = scatteredBy(fogConstituent(frame), frame.ambient);
  return groups;
}

using Values = std::array<double, kTerms>; // of the terms' polynomials, for a direction

Values valuesAt(const dvec3& d) {
  return {1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
}

// What harmonics of degree 2 have between so many directions all around is at most 2 % of what they have there.
const std::vector<Values>& valuesAround() {
  static const std::vector<Values> values = [] {
    constexpr int kSteps = 16;
    std::vector<Values> all;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j < 2 * kSteps; ++j) {
        const double polar = glm::pi<double>() * i / kSteps, around = glm::pi<double>() * j / kSteps;
        all.push_back(
            valuesAt({std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)}));
      }
    return all;
  }();
  return values;
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
  const Groups groups = groupsOf(frame);
  double greatest = 0;
  for (const Terms& terms : groups)
    for (const dvec3& term : terms)
      greatest = std::max({greatest, std::abs(term.x), std::abs(term.y), std::abs(term.z)});
  if (greatest == 0) return block;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t i = 0; i < kTerms; ++i)
      block.ambientHarmonics[g * kTerms + i] = glm::dvec4(groups[g][i] / greatest, 0);
  block.ambientScale = static_cast<float>(std::min(greatest, kBrightest));
  block.occlusionSize = occlusionSize;
  return block;
}

double brightestAmbient(const Frame& frame) {
  constexpr Values kMost = {1, 1, 1, 1, 0.5, 0.5, 2, 0.5, 1}; // of the terms' polynomials
  const dvec3 way = longestWay(frame.medium, cameraOrigin(frame.camera), 1e300);
  dvec3 most(0);
  for (const Constituent& constituent : frame.medium.constituents) {
    const Terms terms = scatteredBy(constituent, frame.ambient);
    for (std::size_t i = 0; i < kTerms; ++i)
      most += kMost[i] * glm::abs(terms[i]);
  }
  dvec3 fog(0); // all that it takes, within no length
  if (isFogLit(frame)) {
    const Terms terms = scatteredBy(fogConstituent(frame), frame.ambient);
    for (std::size_t i = 0; i < kTerms; ++i)
      fog += kMost[i] * glm::abs(terms[i]);
  }
  double brightest = 0;
  for (int c = 0; c < 3; ++c)
    brightest = std::max(brightest, (most[c] > 0 ? most[c] * way[c] : 0) + fog[c]);
  return brightest;
}

double leastAmbient(const Frame& frame) {
  const auto isBlack = [](const Rgb& colour) { return colour == Rgb{0, 0, 0}; };
  const auto& harmonics = frame.ambient.harmonics;
  if (std::all_of(harmonics.begin(), harmonics.end(), isBlack)) return 0;
  double worst = 0;
  for (const Terms& terms : groupsOf(frame)) {
    if (terms == Terms{}) continue;
    double least = 0, most = 0;
    for (const Values& values : valuesAround()) {
      dvec3 sum(0);
      for (std::size_t i = 0; i < kTerms; ++i)
        sum += values[i] * terms[i];
      least = std::min({least, sum.x, sum.y, sum.z});
      most = std::max({most, std::abs(sum.x), std::abs(sum.y), std::abs(sum.z)});
    }
    if (most > 0) worst = std::min(worst, least / most);
  }
  return worst;
}

} // namespace tyndall::optics
