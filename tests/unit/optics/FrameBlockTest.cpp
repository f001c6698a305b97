// A frame's uniform block (optics/Blocks.h): camera rays and the medium.
#include "OpticsCases.h"
#include "optics/Blocks.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <reference/Optics.h>

using namespace tests;
using glm::dvec2;
using glm::dvec3;
using tyndall::Constituent;
using tyndall::Frame;
using tyndall::Medium;
using tyndall::Phase;
using tyndall::blocks::FrameBlock;
using tyndall::optics::cameraOrigin;
using tyndall::optics::extinctionOf;
using tyndall::optics::farthestEnd;
using tyndall::optics::frameBlock;
using tyndall::optics::isMonochrome;
using tyndall::optics::peakPhase;
using tyndall::optics::scatteringOf;

namespace {

const dvec3 kEye(3, -2, 7), kDirection(0.4, -0.2, -1);
constexpr int kWidth = 64, kHeight = 40;

Frame frameWith(const Projection& p, double scale = 1) {
  return frameOf(cameraOf(p, scale * kEye, kDirection), kWidth, kHeight);
}

// As lib/camera.glsl reads it: the point at a window position and a depth, relative to the camera's origin.
dvec3 pointAt(const FrameBlock& block, const dvec2& window, double depth) {
  const dvec2 p = window - 0.5 * dvec2(block.frameSize);
  const double t = block.depthOffset + block.depthScale * depth;
  const glm::dvec4 at = glm::dvec4(block.farPoint[0]) + p.x * glm::dvec4(block.farPoint[1]) +
                        p.y * glm::dvec4(block.farPoint[2]) + t * glm::dvec4(block.nearStep);
  return dvec3(at) / at.w;
}

// A point that the camera sees, between a window's edges and the planes.
dvec3 seenPoint(const Projection& p, double scale, Random& random) {
  const double far = std::isfinite(p.farPlane) ? p.farPlane : 1e3 * scale, along = random.within(p.nearPlane, far);
  const glm::dvec4 clip = p.clipFromView * glm::dvec4(0, 0, -along, 1);
  glm::dvec4 view = glm::inverse(p.clipFromView) *
                    glm::dvec4(clip.w * random.within(-1, 1), clip.w * random.within(-1, 1), clip.z, clip.w);
  return glm::inverse(host::viewLooking(scale * kEye, kDirection)) * (view / view.w);
}

Constituent constituent(const tyndall::Rgb& scattering, Phase phase, float g) { return {scattering, phase, g}; }

double phaseOf(const FrameBlock& block, double cosine, int channel) { // as lib/phase.glsl
  double sum = 0;
  for (int k = 0; k < block.constituentCount; ++k) {
    const glm::dvec4 shape(block.phaseShape[k]);
    const double d = shape.x + shape.y * (shape.w > 0 ? 1 - cosine : 1 + cosine);
    sum += block.phaseWeight[k][channel] * (1 + shape.z * cosine * cosine) / std::pow(d, 1.5);
  }
  return sum;
}

Medium mixture() {
  Medium medium;
  medium.constituents = {constituent({0.1F, 0.2F, 0}, Phase::Isotropic, 0),
                         constituent({0.3F, 0.1F, 0}, Phase::Rayleigh, 0),
                         constituent({0.2F, 0.1F, 0.5F}, Phase::HenyeyGreenstein, 0.8F),
                         constituent({0.1F, 0.4F, 0}, Phase::CornetteShanks, -0.6F)};
  medium.absorption = {0.25F, 0, 1};
  return medium;
}

} // namespace

TEST_CASE("a pixel's position and depth lead back to the point that it shows, in every convention") {
  Random random(41);
  for (const double scale : {1e-25, 1e-6, 1.0, 1e6, 1e25})
    for (const Projection& p : projections(scale)) {
      CAPTURE(p.name, scale);
      const Frame frame = frameWith(p, scale);
      const FrameBlock block = frameBlock(frame, {});
      CHECK(block.isOrthographic == (p.orthographic ? 1 : 0));
      for (int i = 0; i < 50; ++i) {
        const dvec3 point = seenPoint(p, scale, random);
        const Seen seen = seenAt(frame, point);
        const dvec3 back = pointAt(block, seen.window, seen.depth), there = point - cameraOrigin(frame.camera);
        const double length = glm::length(there); // float's rounding, by the slope of depth
        CHECK(glm::distance(back, there) < 5e-7 * (p.orthographic ? p.farPlane : length * length / p.nearPlane));
      }
    }
}

TEST_CASE("a camera far from the world's origin has the rays of one at it") {
  for (const Projection& p : projections()) {
    CAPTURE(p.name);
    const FrameBlock here = frameBlock(frameOf(cameraOf(p, {0, 0, 0}, kDirection), kWidth, kHeight), {});
    const FrameBlock there = frameBlock(frameOf(cameraOf(p, {3e6, -2e6, 1e6}, kDirection), kWidth, kHeight), {});
    for (const dvec2& window : {dvec2(0.5), dvec2(31, 7), dvec2(63.5, 39.5)}) {
      const dvec3 a = pointAt(here, window, 0.5), b = pointAt(there, window, 0.5);
      CHECK(glm::distance(a, b) < 1e-5 * glm::length(a));
    }
  }
}

TEST_CASE("rays end at the far plane's corners, or at the sky") {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Projection& p : projections(scale))
      for (const double sky : {tyndall::kInfinity, 1.0 * scale, 500 * scale}) {
        CAPTURE(p.name, scale, sky);
        Frame frame = frameWith(p, scale);
        frame.medium.farDistance = sky;
        double farthest = 0; // of the corners
        for (const dvec2& ndc : {dvec2(-1, -1), dvec2(1, -1), dvec2(-1, 1), dvec2(1, 1)}) {
          if (!std::isfinite(p.farPlane)) continue;
          const glm::dvec4 view = glm::inverse(p.clipFromView) * glm::dvec4(ndc, host::ndcFar(p.convention), 1);
          farthest = std::max(farthest, p.orthographic ? p.farPlane - p.nearPlane : glm::length(dvec3(view) / view.w));
        }
        const double expected = std::max(farthest, std::min(sky, 1e30)), found = farthestEnd(frameBlock(frame, {}));
        CHECK(found / expected == Approx(1).epsilon(1e-5));
      }
}

TEST_CASE("extinction is all scattering and the absorption; 40 optical depths are seen of what scatters") {
  const Medium medium = mixture();
  const dvec3 scattering = scatteringOf(medium), extinction = extinctionOf(medium);
  CHECK(glm::distance(scattering, {0.7, 0.8, 0.5}) < 1e-6);
  CHECK(glm::distance(extinction, {0.95, 0.8, 1.5}) < 1e-6);
  Frame frame = frameWith(projections()[0]);
  frame.medium = medium;
  CHECK(frameBlock(frame, {}).visibleEnd == Approx(40 / 0.8).epsilon(1e-5));
  frame.medium.constituents.resize(1); // blue is clear of what scatters, and does not count
  frame.medium.absorption = {0, 0, 1e-3F};
  CHECK(frameBlock(frame, {}).visibleEnd == Approx(40 / 0.1).epsilon(1e-5));
  frame.medium.constituents.clear();
  CHECK(frameBlock(frame, {}).visibleEnd == 0);
  frame.medium.constituents = {constituent({1e-30F, 0, 0}, Phase::Isotropic, 0)};
  CHECK(frameBlock(frame, {}).visibleEnd == Approx(1e15));
}

TEST_CASE("the phase function of all constituents is their mean by scattering, and 1 over the sphere") {
  Frame frame = frameWith(projections()[0]);
  for (const float g : {-0.99F, -0.3F, 0.0F, 0.5F, 0.95F}) {
    frame.medium = mixture();
    frame.medium.constituents[2].g = g;
    frame.medium.constituents[3].g = g;
    const FrameBlock block = frameBlock(frame, {});
    const dvec3 scattering = scatteringOf(frame.medium);
    CAPTURE(g);
    for (int channel = 0; channel < 3; ++channel) {
      constexpr int kSteps = 20000;
      double sum = 0;
      for (int i = 0; i < kSteps; ++i) { // finer towards both poles, where the peaks are
        const double x = (i + 0.5) / kSteps, cosine = -std::cos(glm::pi<double>() * x);
        const double one = phaseOf(block, cosine, channel);
        sum += one * std::sqrt(1 - cosine * cosine) * glm::pi<double>() / kSteps * 2 * glm::pi<double>();
        if (i % 500 != 0) continue;
        double mean = 0;
        for (const Constituent& c : frame.medium.constituents)
          mean += c.scattering[static_cast<std::size_t>(channel)] / scattering[channel] *
                  reference::phase(c.phase, c.g, cosine);
        CHECK(one == Approx(mean).epsilon(2e-5));
      }
      CHECK(sum == Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("no direction scatters more than the peak, and one constituent's peak is reached") {
  Random random(42);
  Frame frame = frameWith(projections()[0]);
  for (int trial = 0; trial < 40; ++trial) {
    frame.medium = mixture();
    for (Constituent& c : frame.medium.constituents)
      c.g = static_cast<float>(random.within(-0.98, 0.98));
    const bool single = trial % 2 == 0;
    if (single)
      frame.medium.constituents.erase(frame.medium.constituents.begin(), frame.medium.constituents.begin() + 2);
    if (single) frame.medium.constituents.resize(1);
    const FrameBlock block = frameBlock(frame, {});
    const dvec3 peak = peakPhase(block);
    for (int channel = 0; channel < 3; ++channel) {
      double most = 0;
      for (int i = 0; i <= 200; ++i)
        most = std::max(most, phaseOf(block, i / 100.0 - 1, channel));
      CHECK(most <= peak[channel] * (1 + 1e-6));
      if (single) CHECK(most == Approx(peak[channel]).epsilon(1e-5));
    }
  }
}

TEST_CASE("a medium is monochrome if light of all colours fares alike, whatever the scattering's colour") {
  Medium medium;
  medium.constituents = {constituent({0.1F, 0.1F, 0.1F}, Phase::Rayleigh, 0),
                         constituent({0.3F, 0.3F, 0.3F}, Phase::HenyeyGreenstein, 0.5F)};
  CHECK(isMonochrome(medium));
  medium.absorption = {0.5F, 0.5F, 0.5F};
  CHECK(isMonochrome(medium));
  medium.absorption = {0.5F, 0.5F, 0.25F};
  CHECK_FALSE(isMonochrome(medium));
  medium.absorption = {0, 0, 0};
  medium.constituents[0].scattering = {0.3F, 0.1F, 0.1F};
  medium.constituents[1].scattering = {0.1F, 0.3F, 0.3F}; // equal extinction, but other shares
  CHECK_FALSE(isMonochrome(medium));
  Medium coloured; // one constituent of a colour, absorption of the complement
  coloured.constituents = {constituent({0.25F, 0.5F, 0}, Phase::Rayleigh, 0)};
  coloured.absorption = {0.25F, 0, 0.5F};
  CHECK(isMonochrome(coloured));
  CHECK(isMonochrome(Medium{}));
}
