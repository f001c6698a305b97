// A medium part of which thins out with height, along one ray and towards one light, in double precision.
#pragma once

#include "Ray.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace reference {

/// True if a coefficient that is not 0 follows a layer.
bool isLayered(const tyndall::Medium& medium);

/// Optical depth, per channel, of a straight way from a point on.
Rgb opticalDepth(const tyndall::Medium& medium, const glm::dvec3& from, const glm::dvec3& way);

class HeightFog {
public:
  HeightFog(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray);

  /// Of the whole way of the light: from the lamp, or from where the medium begins for it, to the point s of the ray
  /// and on to the eye.
  Rgb depth(double s) const;
  Rgb eyeDepth(double s) const;

  /// Sum over constituents of sigma_k at s times the phase function, 1/(world unit sr).
  Rgb scattering(double s, double cosTheta) const;
  /// The same with numbers in place of each constituent's phase function.
  Rgb scattering(double s, const std::vector<Rgb>& factors) const;

  /// About how fast scattering and the light's way change at s, as a logarithm, 1/world unit.
  double rate(double s) const;

  /// Where along the ray a quadrature should stop for a moment: grounds, and every second e-fold of what may be seen.
  const std::vector<double>& breaks() const { return breaks_; }

  /// Behind it nothing reaches the eye, or nothing is there.
  double end() const { return end_; }

private:
  double exponent(std::size_t layer, const glm::dvec3& x) const;
  Rgb extinction(double s) const;
  void addBreaks(std::size_t layer);
  bool isNothingBehind(double s) const;

  tyndall::Medium medium_;
  tyndall::Light light_;
  Ray ray_;
  std::vector<double> breaks_;
  double end_ = 0;
};

} // namespace reference
