#include "SampleBudget.h"

#include "optics/Blocks.h"
#include "optics/EyeLight.h"
#include "optics/LightVolume.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

// Each light's part of `budget` by its weight, none above `most` or under kLeastSamples. Parts that would be are cut or
// raised and settled, the rest is dealt again; of both kinds at once only that which weighs more in the sum, since the
// others may then be within their limits.
std::vector<double> partsOf(double budget, const std::vector<double>& weights, double most) {
  std::vector<double> parts(weights.size(), 0);
  std::vector<bool> settled(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    settled[i] = !(weights[i] > 0);
  bool changed = true;
  while (changed) {
    changed = false;
    double left = budget, sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      left -= settled[i] ? parts[i] : 0;
      sum += settled[i] ? 0 : weights[i];
    }
    std::vector<double> raised(weights.size(), 0); // by how much a part is, below 0 if it is cut
    double balance = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (settled[i]) continue;
      const double part = std::max(left, 0.0) * weights[i] / sum;
      parts[i] = std::clamp(part, std::min<double>(kLeastSamples, most), most);
      raised[i] = parts[i] - part;
      balance += raised[i];
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      if ((raised[i] > 0 && balance >= 0) || (raised[i] < 0 && balance <= 0)) settled[i] = changed = true;
  }
  return parts;
}

} // namespace

std::vector<Settings> dealSamples(const Frame& frame, const std::vector<bool>& drawn) {
  const Settings& settings = frame.settings;
  std::vector<Settings> dealt(frame.lights.size(), settings);
  if (settings.sampleBudget == 0 || settings.technique != Technique::Epipolar) return dealt;
  std::vector<double> weights;
  Medium medium = frame.medium;
  const bool isFogAlone = optics::isFogLit(frame) && optics::scatteringOf(medium) == glm::dvec3(0);
  if (isFogAlone) medium.farDistance = std::min(medium.farDistance, frame.eyeCurves.farDistance);
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const optics::LightShare share = optics::shareOf(frame.lights[i], frame.camera, medium);
    weights.push_back(drawn[i] ? std::max(share.brightness * std::sqrt(share.area), 1e-30) : 0);
  }
  const double most = static_cast<double>(settings.slices) * settings.samples;
  const std::vector<double> parts = partsOf(settings.sampleBudget, weights, most);
  for (std::size_t i = 0; i < dealt.size(); ++i) {
    if (!drawn[i]) continue;
    const double scale = std::sqrt(parts[i] / most);
    dealt[i].samples = std::clamp(static_cast<int>(settings.samples * scale) / 64 * 64, 64, settings.samples);
    // In steps, so that textures are not made anew whenever a light or the camera moves a little.
    constexpr int kStep = 32;
    const int slices = static_cast<int>(parts[i] / dealt[i].samples) / kStep * kStep;
    dealt[i].slices = std::min(std::max(slices, kStep), settings.slices);
  }
  return dealt;
}

} // namespace tyndall
