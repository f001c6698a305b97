// Unshadowed light against closed forms and adaptive quadrature: every light, every phase function, extinction from 0
// to 100 and distances from 1e-2 to 1e5.
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace {

constexpr int kDistances = 29;  // columns: 1e-2 to 1e5, four to a decade
constexpr int kDirections = 16; // rows: directions across the field of view
constexpr double kNear = 1e-3;

struct Sweep {
  Light light;
  Constituent constituent; // its scattering is set per extinction
};

// Depth such that column c ends at view depth 1e-2 10^(c/4).
std::vector<float> sweepDepth() {
  std::vector<float> depth;
  for (int row = 0; row < kDirections; ++row)
    for (int column = 0; column < kDistances; ++column)
      depth.push_back(static_cast<float>(kNear / (1e-2 * std::pow(10.0, column / 4.0))));
  return depth;
}

const std::vector<Rgb> kExtinctions = {{0, 1e-7F, 1e-6F}, {1e-5F, 1e-4F, 1e-3F}, {0.01F, 0.03F, 0.1F},
                                       {0.3F, 1, 3},      {10, 30, 100},         {0, 0.1F, 100}};

std::vector<double> truthOf(tests::FrameRig& rig) { return rig.reference().inscatter.rgb; }

// How far the truth itself moves, per value, if the light's position and axis and the ray's length are rounded to
// float32 as the effect must do: where a ray grazes a cone or ends just behind its wall, that is more than the
// integral's error.
std::vector<double> conditioning(tests::FrameRig& rig, const std::vector<double>& truth) {
  constexpr double kRounding = 2.4e-7; // four roundings of float32
  const Light light = rig.frame.lights[0];
  const Vec3 eye = {1, 2, 3};
  std::vector<double> moved(truth.size(), 0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      double distance = 0;
      for (std::size_t k = 0; k < 3; ++k)
        distance = std::hypot(distance, light.position[k] - eye[k]);
      rig.frame.lights[0] = light;
      rig.frame.lights[0].position[axis] += sign * kRounding * distance;
      const std::vector<double> other = truthOf(rig);
      for (std::size_t i = 0; i < truth.size(); ++i)
        moved[i] += 0.5 * std::abs(other[i] - truth[i]);
    }
  rig.frame.lights[0] = light;
  for (const double sign : {-1.0, 1.0}) {
    rig.frame.lights[0].outerConeAngle = light.outerConeAngle + sign * kRounding;
    const std::vector<double> other = truthOf(rig);
    for (std::size_t i = 0; i < truth.size(); ++i)
      moved[i] += 0.5 * std::abs(other[i] - truth[i]);
  }
  rig.frame.lights[0] = light;
  const Mat4 projection = rig.frame.camera.clipFromView;
  for (const double sign : {-1.0, 1.0}) {
    rig.frame.camera.clipFromView[14] = projection[14] * (1 + sign * kRounding); // scales all distances
    const std::vector<double> other = truthOf(rig);
    for (std::size_t i = 0; i < truth.size(); ++i)
      moved[i] += 0.5 * std::abs(other[i] - truth[i]);
  }
  rig.frame.camera.clipFromView = projection;
  return moved;
}

// The largest error of a sweep: relative, or absolute against the sweep's largest value where it is under 1e-12 of
// that.
double sweepError(const Sweep& sweep) {
  tests::FrameRig rig(kDistances, kDirections, sweepDepth());
  rig.frame.camera.viewFromWorld = tests::lookAt({1, 2, 3}, {1.3, 2.1, 0});
  rig.frame.camera.clipFromView = tests::reversedInfinite(1.2, 1.7, kNear);
  rig.frame.camera.clipDepth = ClipDepth::ZeroToOne;
  rig.frame.lights = {sweep.light};
  std::vector<double> values, references, slack;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const Rgb& sigma : kExtinctions) {
    Constituent c = sweep.constituent;
    for (std::size_t k = 0; k < 3; ++k) {
      c.scattering[k] = 0.7F * sigma[k];
      rig.frame.medium.absorption[k] = 0.3F * sigma[k];
    }
    rig.frame.medium.constituents = {c};
    append(values, rig.render().inscatter.rgb);
    const std::vector<double> truth = truthOf(rig);
    append(references, truth);
    append(slack,
           sweep.light.kind == LightKind::Spot ? conditioning(rig, truth) : std::vector<double>(truth.size(), 0));
  }
  const double largest = *std::max_element(references.begin(), references.end());
  REQUIRE(largest > 0);
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    REQUIRE(std::isfinite(values[i]));
    const double error =
        std::max(0.0, std::abs(values[i] - references[i]) - slack[i]) / std::max(references[i], 1e-12 * largest);
    if (error > worst) at = i;
    worst = std::max(worst, error);
  }
  const std::size_t pixel = (at / 3) % (kDistances * kDirections);
  UNSCOPED_INFO("worst: distance " << pixel % kDistances << " direction " << pixel / kDistances << " extinctions "
                                   << at / 3 / (kDistances * kDirections) << " channel " << at % 3 << ": " << values[at]
                                   << " for " << references[at] << " slack " << slack[at] << ", largest " << largest);
  return worst;
}

const std::vector<Constituent> kConstituents = {{{}, Phase::Isotropic, 0},
                                                {{}, Phase::Rayleigh, 0},
                                                {{}, Phase::HenyeyGreenstein, 0.6F},
                                                {{}, Phase::HenyeyGreenstein, -0.5F},
                                                {{}, Phase::HenyeyGreenstein, 0.95F},
                                                {{}, Phase::CornetteShanks, 0.76F}};

} // namespace

TEST_CASE("unshadowed directional light equals its closed form", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const Vec3& direction : {Vec3{0, -1, 0}, Vec3{0.3, -0.2, 1}, Vec3{-0.1, -0.05, -1}, Vec3{-0.35, -0.13, 3}}) {
      Sweep sweep{{}, c};
      sweep.light.direction = direction;
      sweep.light.colour = {3, 2, 1};
      CAPTURE(static_cast<int>(c.phase), c.g, direction[0], direction[2]);
      CHECK(sweepError(sweep) <= 1e-5);
    }
}

TEST_CASE("a directional light in a bounded medium equals its closed form") {
  for (const Vec3& normal : {Vec3{0, 1, 0}, Vec3{0.2, 1, -0.4}, Vec3{0.3, 1, 1}}) {
    Sweep sweep{{}, kConstituents[2]};
    sweep.light.direction = {0.3, -1, 0.4};
    sweep.light.boundary = {true, {0, 2.2, 0}, normal};
    CAPTURE(normal[0], normal[1], normal[2]);
    CHECK(sweepError(sweep) <= 1e-5);
  }
}

TEST_CASE("unshadowed point light equals adaptive quadrature", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const Vec3& position :
         {Vec3{1, 3, 1}, Vec3{-20, 5, -300}, Vec3{1.05, 2.01, 2.9}, Vec3{0.5, 1.5, 30}, Vec3{2e4, 1e4, -7e4}}) {
      Sweep sweep{{}, c};
      sweep.light.kind = LightKind::Point;
      sweep.light.position = position;
      CAPTURE(static_cast<int>(c.phase), c.g, position[0], position[2]);
      CHECK(sweepError(sweep) <= 1e-4);
    }
}

TEST_CASE("unshadowed spot light equals adaptive quadrature", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const double outer : {0.05, 0.6, 1.5707963267948966})
      for (const double inner : {0.0, 0.7, 1.0}) {
        Sweep sweep{{}, c};
        sweep.light.kind = LightKind::Spot;
        sweep.light.position = {3, 4, -2};
        sweep.light.direction = {-0.6, -0.55, 0.2};
        sweep.light.outerConeAngle = outer;
        sweep.light.innerConeAngle = inner * outer;
        sweep.light.range = outer > 1 ? 50 : kInfinity;
        CAPTURE(static_cast<int>(c.phase), c.g, outer, inner);
        CHECK(sweepError(sweep) <= 1e-4);
      }
}
