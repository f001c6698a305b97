#include "Optics.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace reference {
namespace {

constexpr double kPi = glm::pi<double>();

/// exp(-x) is 0 in double precision beyond this.
constexpr double kUnderflow = 746;

constexpr double kGauss3X[] = {-0.7745966692414834, 0, 0.7745966692414834};
constexpr double kGauss3W[] = {0.5555555555555556, 0.8888888888888888, 0.5555555555555556};
constexpr double kGauss5X[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
constexpr double kGauss5W[] = {0.23692688505618908, 0.47862867049936647, 0.5688888888888889, 0.47862867049936647,
                               0.23692688505618908};

/// Gauss-Kronrod with 7 and 15 nodes: abscissa, Kronrod weight, Gauss weight; mirrored but for the last.
struct KronrodNode {
  double x;
  double kronrod;
  double gauss;
};
constexpr KronrodNode kKronrod15[] = {
    {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0},
    {0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
    {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
    {0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
    {0.586087235467691130294144838258730, 0.169004726639267902826583426598550, 0},
    {0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
    {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
    {0, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327}};

/// Integral of exp(-sigma (c + q s)) over [a, b]. Starts from the brighter end, so that nothing overflows.
double exponentialSpan(double sigma, double c, double q, double a, double b) {
  const double rate = sigma * q;
  const double start = rate >= 0 ? a : b;
  const double x = std::abs(rate) * (b - a);
  const double mean = x > 0 ? -std::expm1(-x) / x : 1;
  return std::exp(-sigma * (c + q * start)) * (b - a) * mean;
}

} // namespace

double phase(tyndall::Phase kind, double g, double cosTheta) {
  const double base = (1 - g) * (1 - g) + 2 * g * (1 - cosTheta);
  switch (kind) {
  case tyndall::Phase::Isotropic:
    return 1 / (4 * kPi);
  case tyndall::Phase::Rayleigh:
    return 3 / (16 * kPi) * (1 + cosTheta * cosTheta);
  case tyndall::Phase::HenyeyGreenstein:
    return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
  case tyndall::Phase::CornetteShanks:
    return 3 * (1 - g * g) * (1 + cosTheta * cosTheta) / (8 * kPi * (2 + g * g) * base * std::sqrt(base));
  }
  return 0;
}

Rgb extinction(const tyndall::Medium& medium) {
  Rgb sum = toRgb(medium.absorption);
  for (const tyndall::Constituent& constituent : medium.constituents)
    sum += toRgb(constituent.scattering);
  return sum;
}

Rgb transmittance(const tyndall::Medium& medium, const Ray& ray, double distance) {
  if (isLayered(medium)) return glm::exp(-opticalDepth(medium, ray.origin, std::min(distance, 1e30) * ray.direction));
  const Rgb sigma = extinction(medium);
  Rgb result{1};
  for (int c = 0; c < 3; ++c)
    if (sigma[c] > 0) result[c] = std::exp(-sigma[c] * distance);
  return result;
}

double spotFalloff(const tyndall::Light& light, double cosAngle) {
  const double outer = std::cos(light.outerConeAngle);
  const double width = std::cos(light.innerConeAngle) - outer;
  if (width < 1e-6) return cosAngle >= outer ? 1 : 0;
  const double x = std::clamp((cosAngle - outer) / width, 0.0, 1.0);
  return x * x;
}

Airlight::Airlight(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray)
    : ray_(ray), light_(light), constituents_(medium.constituents),
      colour_(toRgb(light.colour) * double(light.scatteringScale)), extinction_(extinction(medium)) {
  maxExtinction_ = std::max({extinction_.r, extinction_.g, extinction_.b});
  grey_ = extinction_.r == extinction_.g && extinction_.g == extinction_.b;
  // The thinnest channel in which anything scatters says how far the ray matters: of fog before the eye, whose
  // scattering takes nothing (MapExact.cpp), without an end.
  Rgb scattering(0);
  for (const tyndall::Constituent& constituent : constituents_)
    scattering += toRgb(constituent.scattering);
  double thinnest = kInfinity;
  for (int c = 0; c < 3; ++c)
    if (scattering[c] > 0) thinnest = std::min(thinnest, std::max(extinction_[c], 0.0));
  support_ = {0, std::isinf(thinnest) ? 0 : std::min(1e30, kUnderflow / thinnest)};
  if (isLayered(medium)) {
    layers_.emplace(medium, light, ray);
    support_ = {0, layers_->end()};
    breaks_ = layers_->breaks();
  }
  isPoint_ = light.kind != tyndall::LightKind::Directional;
  if (isPoint_)
    preparePoint(light);
  else
    prepareDirectional(light);
  std::sort(breaks_.begin(), breaks_.end());
}

Airlight::Airlight(const tyndall::Medium& medium, const std::vector<Rgb>& radiances, const Ray& ray)
    : Airlight(medium, tyndall::Light{}, ray) {
  radiances_ = radiances;
  source_ = Rgb(0);
  for (std::size_t k = 0; k < constituents_.size(); ++k)
    source_ += toRgb(constituents_[k].scattering) * radiances[k];
}

Rgb Airlight::scatteringAt(double s) const {
  if (!radiances_.empty()) return layers_->scattering(s, radiances_);
  return colour_ * layers_->scattering(s, glm::dot(glm::normalize(toVec3(light_.direction)), -ray_.direction));
}

Rgb Airlight::phaseSum(double cosTheta) const {
  Rgb sum{0};
  for (const tyndall::Constituent& constituent : constituents_)
    sum += toRgb(constituent.scattering) * phase(constituent.phase, constituent.g, cosTheta);
  return sum;
}

Rgb Airlight::expExtinction(double distance) const {
  if (grey_) return Rgb(std::exp(-extinction_.r * distance));
  return glm::exp(-extinction_ * distance);
}

// ---------------------------------------------------------------------------------------------------------------------
// Directional light

void Airlight::prepareDirectional(const tyndall::Light& light) {
  const glm::dvec3 travel = glm::normalize(toVec3(light.direction));
  source_ = colour_ * phaseSum(glm::dot(travel, -ray_.direction));
  if (!light.boundary.enabled) return;
  // The light that reaches x entered at x - d travel with d = (x - p).n / travel.n, which is linear along the ray.
  const glm::dvec3 normal = toVec3(light.boundary.normal);
  const double along = glm::dot(travel, normal);
  boundaryOffset_ = glm::dot(ray_.origin - toVec3(light.boundary.point), normal) / along;
  boundarySlope_ = glm::dot(ray_.direction, normal) / along;
  if (boundarySlope_ != 0) breaks_.push_back(-boundaryOffset_ / boundarySlope_);
}

double Airlight::sunSlope(double s) const { return boundaryOffset_ + boundarySlope_ * s > 0 ? 1 + boundarySlope_ : 1; }

Rgb Airlight::directionalPiece(double s0, double s1) const {
  const double middle = 0.5 * (s0 + s1), q = sunSlope(middle);
  const double c = boundaryOffset_ + boundarySlope_ * middle > 0 ? boundaryOffset_ : 0;
  if (grey_) return source_ * exponentialSpan(extinction_.r, c, q, s0, s1);
  Rgb result;
  for (int i = 0; i < 3; ++i)
    result[i] = source_[i] * exponentialSpan(extinction_[i], c, q, s0, s1);
  return result;
}

Airlight::Node Airlight::directionalNode(double a, double width, double x) const {
  const double s = a + x * width;
  if (layers_) return {s, scatteringAt(s) * glm::exp(-layers_->depth(s))};
  return {s, source_ * expExtinction(s + std::max(0.0, boundaryOffset_ + boundarySlope_ * s))};
}

// ---------------------------------------------------------------------------------------------------------------------
// Point and spot light

void Airlight::preparePoint(const tyndall::Light& light) {
  const glm::dvec3 toLight = toVec3(light.position) - ray_.origin;
  foot_ = glm::dot(toLight, ray_.direction);
  height_ = glm::length(glm::cross(toLight, ray_.direction));
  breaks_.push_back(foot_);
  if (height_ >= light.range) {
    support_ = {0, 0};
    return;
  }
  const double half = std::sqrt((light.range - height_) * (light.range + height_));
  support_ = {std::max(support_.begin, foot_ - half), std::min(support_.end, foot_ + half)};
  // Beyond this 1/r^2 has left nothing to double precision; from the light itself on there is no such place.
  if (std::abs(foot_) + height_ > 0)
    support_.end = std::min(support_.end, std::max(foot_, 0.0) + 1e20 * (std::abs(foot_) + height_));
  spot_ = light.kind == tyndall::LightKind::Spot;
  if (!spot_) return;
  const glm::dvec3 axis = glm::normalize(toVec3(light.direction));
  axisSlope_ = glm::dot(ray_.direction, axis);
  axisAtFoot_ = foot_ * axisSlope_ - glm::dot(toLight, axis);
  cosOuter_ = std::cos(light.outerConeAngle);
  cosInner_ = std::cos(light.innerConeAngle);
  hardCone_ = cosInner_ - cosOuter_ < 1e-6;
  clipToCone();
  if (!hardCone_) addConeCrossings(cosInner_);
}

/// Where the ray crosses a cone around the axis: (a + b t)^2 = c^2 (h^2 + t^2) with a + b t >= 0.
void Airlight::addConeCrossings(double cosCone) {
  const double a = axisAtFoot_, b = axisSlope_, c2 = cosCone * cosCone, h2 = height_ * height_;
  const double discriminant = c2 * (b * b * h2 + a * a - c2 * h2);
  if (discriminant < 0) return;
  const double half = a * b;
  const double q = -(half + std::copysign(std::sqrt(discriminant), half));
  for (const double t : {q / (b * b - c2), (a * a - c2 * h2) / q})
    if (std::isfinite(t) && a + b * t >= 0) breaks_.push_back(foot_ + t);
}

/// A cone of at most a half space is convex: what it holds of the ray is one interval between crossings.
void Airlight::clipToCone() {
  addConeCrossings(cosOuter_);
  std::vector<double> ends = {support_.begin, support_.end};
  for (const double s : breaks_)
    if (s > support_.begin && s < support_.end) ends.push_back(s);
  std::sort(ends.begin(), ends.end());
  Interval inside{0, 0};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double t = 0.5 * (ends[i] + ends[i + 1]) - foot_;
    if (axisAtFoot_ + axisSlope_ * t < cosOuter_ * std::hypot(t, height_)) continue;
    if (inside.end == 0) inside.begin = ends[i];
    inside.end = ends[i + 1];
  }
  support_ = inside;
}

Airlight::Panel Airlight::panel(double s0, double s1) const {
  const double side = 0.5 * (s0 + s1) >= foot_ ? 1 : -1;
  const double t0 = std::max(0.0, side > 0 ? s0 - foot_ : foot_ - s1);
  const double t1 = t0 + (s1 - s0);
  const double r0 = std::hypot(t0, height_);
  const double r1 = std::hypot(t1, height_);
  const double growth = (s1 - s0) * (1 + (t0 + t1) / (r0 + r1));
  return {side, t0 + r0, std::log1p(growth / (t0 + r0))};
}

Airlight::Node Airlight::pointNode(const Panel& panel, double x) const {
  const double e = panel.e0 * std::exp(x * panel.width);
  const double q = height_ * (height_ / e);
  const double t = panel.side * 0.5 * (e - q);
  const double r = 0.5 * (e + q);
  double strength = 1 / r;
  if (spot_ && !hardCone_) {
    const double cosAngle = (axisAtFoot_ + axisSlope_ * t) / r;
    const double falloff = std::clamp((cosAngle - cosOuter_) / (cosInner_ - cosOuter_), 0.0, 1.0);
    strength *= falloff * falloff;
  }
  if (layers_) {
    const double s = std::max(foot_ + t, 0.0);
    return {foot_ + t, colour_ * layers_->scattering(s, -t / r) * glm::exp(-layers_->depth(s)) * strength};
  }
  const double path = foot_ + (panel.side > 0 ? e : q);
  return {foot_ + t, colour_ * phaseSum(-t / r) * expExtinction(path) * strength};
}

/// How much the integrand varies over a panel: its width in w and half the change of the optical path.
double Airlight::panelVariation(const Panel& panel) const {
  const double change =
      panel.side > 0 ? panel.e0 * std::expm1(panel.width) : height_ * (height_ / panel.e0) * -std::expm1(-panel.width);
  return std::max(panel.width, 0.5 * maxExtinction_ * change);
}

Airlight::Nodes Airlight::nodesFor(double variation) {
  if (variation <= 0.01) return {3, kGauss3X, kGauss3W};
  return {5, kGauss5X, kGauss5W};
}

void addAdaptive(const std::function<Rgb(double)>& f, double a, double b, Rgb& sum, int depth) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Rgb kronrod{0}, gauss{0};
  for (const KronrodNode& node : kKronrod15) {
    Rgb value = f(middle + half * node.x);
    if (node.x > 0) value += f(middle - half * node.x);
    kronrod += node.kronrod * value;
    gauss += node.gauss * value;
  }
  kronrod *= half;
  gauss *= half;
  const Rgb error = glm::abs(kronrod - gauss);
  constexpr double kNothing = 1e-290; // under this a relative error is that of numbers that lose their bits
  const Rgb allowed = glm::max(1e-10 * glm::max(kronrod, sum), Rgb(kNothing));
  if (depth == 0 || glm::all(glm::lessThanEqual(error, allowed))) {
    sum += kronrod;
    return;
  }
  addAdaptive(f, a, middle, sum, depth - 1);
  addAdaptive(f, middle, b, sum, depth - 1);
}

Rgb Airlight::pointPiece(double s0, double s1) const {
  const Panel whole = panel(s0, s1);
  if (whole.e0 <= 0) { // the light itself
    Rgb endless = colour_ * phaseSum(-whole.side);
    for (int c = 0; c < 3; ++c)
      if (endless[c] > 0) endless[c] = kInfinity;
    return endless;
  }
  const double variation = panelVariation(whole);
  if (variation <= 0.25) {
    const Nodes nodes = nodesFor(variation);
    Rgb sum{0};
    for (int k = 0; k < nodes.count; ++k)
      sum += nodes.weights[k] * pointNode(whole, 0.5 + 0.5 * nodes.abscissas[k]).value;
    return sum * (0.5 * whole.width);
  }
  constexpr double kWidestPanel = 2;
  const int count = static_cast<int>(std::ceil(whole.width / kWidestPanel));
  Rgb total{0};
  for (int i = 0; i < count; ++i)
    addAdaptive([&](double x) { return pointNode(whole, x).value; }, static_cast<double>(i) / count,
                static_cast<double>(i + 1) / count, total, kDeepest);
  return total * whole.width;
}

Rgb Airlight::span(double s0, double s1) const {
  if (layers_) return weighted(s0, s1, [](double) { return 1.0; });
  Rgb sum{0};
  forEachPiece(s0, s1, [&](double a, double b) { sum += isPoint_ ? pointPiece(a, b) : directionalPiece(a, b); });
  return sum;
}

Rgb integrate(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray, double s0, double s1) {
  return Airlight(medium, light, ray).span(s0, s1);
}

} // namespace reference
