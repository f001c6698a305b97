// Single scattering along one ray from one light, without shadows, in double precision.
#pragma once

#include "HeightFog.h"
#include "Ray.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tyndall/tyndall.h>

namespace reference {

/// Phase function in 1/sr; theta is the angle between the light's travel direction and the direction to the eye.
double phase(tyndall::Phase kind, double g, double cosTheta);

/// All scattering plus absorption, 1/world unit; of layers where their density is 1.
Rgb extinction(const tyndall::Medium& medium);

/// exp(-optical depth) from the ray's origin on; the distance may be infinite.
Rgb transmittance(const tyndall::Medium& medium, const Ray& ray, double distance);

/// The cone falloff of KHR_lights_punctual in [0, 1]; a hard step when the two cones' cosines differ by less than 1e-6.
double spotFalloff(const tyndall::Light& light, double cosAngle);

constexpr int kDeepest = 40; ///< halvings

/// Adds the integral of f over [a, b], to a relative 1e-10 of the sum, by Gauss-Kronrod and halving.
void addAdaptive(const std::function<Rgb(double)>& f, double a, double b, Rgb& sum, int depth = kDeepest);

/// The in-scattered radiance that a medium and a light send along one ray to its origin:
///     integral of  exp(-sigma_t s) [sum_k sigma_k p_k] E(s) ds.
/// Directional light has a closed form. For point and spot light let t be the distance past the foot of the
/// perpendicular from the light (length h) to the ray, and r = sqrt(t^2 + h^2). On each side of the foot the
/// substitution  e = |t| + r = e0 exp(w)  turns dt/r^2 into dw/r and leaves an integrand whose phase, falloff and
/// 1/r vary on a scale of 1 in w whatever h is, h = 0 included. The light's path s + r is foot + e behind the foot
/// and foot + h^2/e before it, free of cancellation. Media with layers are integrated by adaptive quadrature.
class Airlight {
public:
  Airlight(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray);

  /// Of light that each constituent has a radiance of its own of to scatter towards the ray's origin, as from all sides
  /// (Ambient.h): a directional one, of which nothing is lost before the ray.
  Airlight(const tyndall::Medium& medium, const std::vector<Rgb>& radiances, const Ray& ray);

  /// The only part of the ray that can contribute: inside range and cone, and before exp(-sigma_t s) underflows.
  /// Always finite.
  Interval support() const { return support_; }

  /// The radiance from the lit span [s0, s1], 0 <= s0; s1 may be infinite. Relative accuracy 1e-9.
  /// Infinite where the span holds the point light itself.
  Rgb span(double s0, double s1) const;

  /// The radiance from [s0, s1] with the light at distance s multiplied by weight(s), an Rgb, smooth and close to
  /// quadratic over the span, which must be finite.
  template <class Weight>
  Rgb weighted(double s0, double s1, const Weight& weight) const {
    Rgb sum{0};
    forEachPiece(
        s0, s1, [&](double a, double b) { sum += layers_ ? layeredPiece(a, b, weight) : weightedPiece(a, b, weight); });
    return sum;
  }

private:
  /// A piece of one side of the foot: e runs from e0 to e0 exp(width); side is +1 behind the foot, -1 before it.
  struct Panel {
    double side;
    double e0;
    double width;
  };
  struct Node {
    double s;
    Rgb value; ///< integrand times ds/dw
  };
  struct Nodes {
    int count;
    const double* abscissas; ///< on [-1, 1]
    const double* weights;
  };

  void prepareDirectional(const tyndall::Light& light);
  void preparePoint(const tyndall::Light& light);
  void addConeCrossings(double cosCone);
  void clipToCone();
  Rgb phaseSum(double cosTheta) const;
  Rgb scatteringAt(double s) const; ///< of layers, directional: times the phase function
  Rgb expExtinction(double distance) const;

  Rgb directionalPiece(double s0, double s1) const;
  Node directionalNode(double a, double width, double x) const;
  Rgb pointPiece(double s0, double s1) const;
  Panel panel(double s0, double s1) const;
  Node pointNode(const Panel& panel, double x) const;
  double panelVariation(const Panel& panel) const;
  static Nodes nodesFor(double variation);
  /// Directional: how the light's path to the eye, from where it entered the medium, grows with s.
  double sunSlope(double s) const;
  /// As wide a stretch, of a panel of width 1 that is brightest at 0, as is not all dark to the nodes of a quadrature.
  double widest(const Panel& panel, double from) const { return isPoint_ ? std::min(from, 2 / panel.width) : from; }

  /// Calls visit(a, b) for the stretches of [s0, s1] between range, cone, foot and boundary plane.
  template <class Visit>
  void forEachPiece(double s0, double s1, const Visit& visit) const {
    double a = std::max(s0, support_.begin);
    const double end = std::min(s1, support_.end);
    for (std::size_t i = 0; a < end && i <= breaks_.size(); ++i) {
      const double b = i < breaks_.size() ? std::min(breaks_[i], end) : end;
      if (b <= a) continue;
      visit(a, b);
      a = b;
    }
  }

  template <class Weight>
  Rgb weightedPiece(double a, double b, const Weight& weight) const {
    constexpr double kEven = 16; // more is not even: most of the light lies next to one end
    const Panel whole = isPoint_ ? panel(a, b) : Panel{1, a, b - a};
    const double variation =
        isPoint_ ? panelVariation(whole) : maxExtinction_ * (1 + std::abs(boundarySlope_)) * (b - a);
    const auto at = [&](double x) {
      const Node node = isPoint_ ? pointNode(whole, x) : directionalNode(a, b - a, x);
      return node.value * weight(node.s);
    };
    if (variation > kEven) {
      const bool isBrightAtEnd = !isPoint_ && sunSlope(0.5 * (a + b)) < 0;
      Rgb sum{0};
      for (double x = 0, next = kEven / variation; x < 1; x = next, next = std::min(next + widest(whole, next), 1.0))
        addAdaptive([&](double y) { return at(isBrightAtEnd ? 1 - y : y); }, x, next, sum, kDeepest);
      return sum * whole.width;
    }
    const int count = static_cast<int>(std::ceil(4 * variation + 1e-9));
    const Nodes nodes = nodesFor(variation / count);
    Rgb sum{0};
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < nodes.count; ++k)
        sum += nodes.weights[k] * at((i + 0.5 + 0.5 * nodes.abscissas[k]) / count);
    return sum * (0.5 * whole.width / count);
  }

  /// Through layers: by the few nodes that a short piece takes, or in parts of which the first is as long as what
  /// changes there fastest, and each next one twice as long.
  template <class Weight>
  Rgb layeredPiece(double a, double b, const Weight& weight) const {
    constexpr double kShort = 0.02;
    double step = 1 / std::max(layers_->rate(a), 1e-300);
    const bool isShort = b - a < kShort * step && b - a < kShort / std::max(layers_->rate(b), 1e-300);
    Rgb sum{0};
    for (double from = a, to = a; from < b; from = to, step *= 2) {
      to = isShort || from + 1.5 * step >= b ? b : from + step;
      const Panel part = isPoint_ ? panel(from, to) : Panel{1, from, to - from};
      const auto at = [&](double x) {
        const Node node = isPoint_ ? pointNode(part, x) : directionalNode(from, to - from, x);
        return node.value * weight(node.s);
      };
      const int count = isPoint_ ? static_cast<int>(std::ceil(part.width / 2)) : 1;
      Rgb own{0};
      if (isShort && part.width < (isPoint_ ? kShort : kInfinity)) {
        const Nodes nodes = nodesFor(kInfinity);
        for (int k = 0; k < nodes.count; ++k)
          own += 0.5 * nodes.weights[k] * at(0.5 + 0.5 * nodes.abscissas[k]);
      } else {
        for (int i = 0; i < count; ++i)
          addAdaptive(at, static_cast<double>(i) / count, (i + 1.0) / count, own, kDeepest);
      }
      sum += own * part.width;
    }
    return sum;
  }

  Ray ray_;
  tyndall::Light light_;
  std::optional<HeightFog> layers_; ///< of a medium that has them
  std::vector<tyndall::Constituent> constituents_;
  std::vector<Rgb> radiances_; ///< of each, in place of the light's; empty: as the light's phase functions have it
  Rgb colour_;
  Rgb extinction_;
  double maxExtinction_ = 0;
  bool grey_ = false;    ///< one extinction for all channels
  bool isPoint_ = false; ///< point or spot
  Interval support_;
  std::vector<double> breaks_; ///< sorted
  Rgb source_{0};              ///< directional: irradiance times the phase sum
  double boundaryOffset_ = 0;  ///< directional: path of the light in the medium is offset + slope s, where positive
  double boundarySlope_ = 0;
  double foot_ = 0;   ///< point, spot: distance along the ray of the point nearest to the light
  double height_ = 0; ///< point, spot: distance of the light from the ray
  bool spot_ = false;
  bool hardCone_ = false;
  double cosOuter_ = 0;
  double cosInner_ = 1;
  double axisAtFoot_ = 0; ///< spot: distance along the cone's axis of the foot, and its growth with t
  double axisSlope_ = 0;
};

/// The radiance from the lit span [s0, s1] of a ray, see Airlight.
Rgb integrate(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray, double s0, double s1);

} // namespace reference
