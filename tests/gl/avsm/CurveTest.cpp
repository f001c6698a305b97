// Curves of adaptive volumetric shadow maps against the segments they are made of.
#include "AvsmRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace tyndall;
using tests::AvsmRig;
using tests::Captured;
using tests::configOf;
using tests::Curve;

namespace {

constexpr CurveReduction kReductions[] = {CurveReduction::Fitted, CurveReduction::WholeCurve, CurveReduction::Sorted,
                                          CurveReduction::InOrder};

// Columns of smoke: puffs of some thickness, thin each, in clusters along the ray.
std::vector<reference::Segment> smoke(int seed, double low = 0, double high = 1) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<reference::Segment> segments;
  for (int column = 0; column < 3; ++column) {
    const double middle = 0.15 + 0.3 * column + 0.1 * uniform(random);
    for (int i = 0; i < 20; ++i) {
      const double at = middle + 0.16 * (uniform(random) - 0.5), half = 0.01 + 0.03 * uniform(random);
      const auto place = [&](double d) { return low + (high - low) * std::clamp(d, 0.0, 1.0); };
      segments.push_back({place(at - half), place(at + half), 1 - 0.08 * uniform(random)});
    }
  }
  return segments;
}

std::vector<Captured> atTexel(const std::vector<reference::Segment>& segments, const glm::ivec3& texel) {
  std::vector<Captured> all;
  for (const reference::Segment& s : segments)
    all.push_back(
        {texel, static_cast<float>(s.entry), static_cast<float>(s.exit), static_cast<float>(s.transmittance)});
  return all;
}

constexpr int kTexels = 8; // across and up, of smoke at each

glm::ivec3 texelOf(int i) { return {i % kTexels, i / kTexels, 0}; }

// Captures smoke of another column in each texel.
void captureSmoke(AvsmRig& rig) {
  std::vector<Captured> all;
  for (int i = 0; i < kTexels * kTexels; ++i)
    for (const Captured& s : atTexel(smoke(i), texelOf(i)))
      all.push_back(s);
  rig.capture(all); // the memory grows
  rig.capture(all);
  REQUIRE(rig.avsm().statistics().lost == 0);
}

void checkShape(const Curve& curve) {
  double depth = 0, passed = 1;
  for (const glm::dvec2& node : curve) {
    CHECK(node.x >= depth);
    CHECK(node.y <= passed + 1e-6);
    CHECK(node.y >= 0);
    CHECK(node.x <= 1);
    depth = node.x;
    passed = node.y;
  }
}

} // namespace

TEST_CASE("avsm: a segment's curve falls between its ends, and at once where they are one") {
  if (!tests::hasAvsm()) return;
  for (const CurveReduction reduction : kReductions)
    for (const bool packed : {false, true}) {
      AvsmRig rig(configOf(reduction, 4, 8, packed));
      rig.capture({{{1, 2, 0}, 0.25F, 0.5F, 0.8F}, {{3, 0, 0}, 0.5F, 0.5F, 0.25F}, {{2, 2, 0}, 0.125F, 0.126F, 0}});
      CAPTURE(static_cast<int>(reduction), packed);
      const std::vector<glm::ivec3> texels = {{1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {3, 0, 0},
                                              {3, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 0, 0}};
      const std::vector<float> depths = {0.1F, 0.25F, 0.375F, 0.75F, 0.49F, 0.51F, 0.12F, 0.2F, 1};
      const std::vector<double> expected = {1, 1, std::sqrt(0.8), 0.8, 1, 0.25, 1, 0, 1};
      const std::vector<float> found = rig.lookUp(texels, depths);
      const std::vector<float> exponential = rig.lookUp(texels, depths, true);
      for (std::size_t i = 0; i < found.size(); ++i) {
        CAPTURE(i);
        CHECK(found[i] == Approx(expected[i]).margin(i == 2 ? 0.008 : packed ? 2e-4 : 1e-6));
        CHECK(exponential[i] == Approx(expected[i]).margin(packed ? 4e-4 : 2e-3));
      }
      const AvsmStatistics statistics = rig.avsm().statistics();
      CHECK(statistics.segments == 3);
      CHECK(statistics.lost == 0);
    }
}

TEST_CASE("avsm: segments that overlap multiply, in any order") {
  if (!tests::hasAvsm()) return;
  const std::vector<reference::Segment> segments = {{0.2, 0.6, 0.7}, {0.3, 0.5, 0.8}, {0.5, 0.5, 0.9}};
  for (const CurveReduction reduction : kReductions) {
    AvsmRig rig(configOf(reduction, 4, 16));
    std::vector<Captured> forward = atTexel(segments, {0, 0, 0}), all = forward;
    std::reverse(forward.begin(), forward.end());
    for (Captured s : forward) {
      s.texel = {1, 0, 0};
      all.push_back(s);
    }
    rig.capture(all);
    CAPTURE(static_cast<int>(reduction));
    for (const glm::ivec3& texel : {glm::ivec3(0), glm::ivec3(1, 0, 0)}) {
      const Curve curve = rig.curve(texel);
      checkShape(curve);
      CHECK(tests::curveError(curve, segments) < (reduction == CurveReduction::WholeCurve ? 1e-3 : 6e-3));
      CHECK(tests::curveAt(curve, 0.99) == Approx(0.7 * 0.8 * 0.9).epsilon(1e-5));
    }
  }
}

TEST_CASE("avsm: curves fall, stay in [0, 1], keep both ends and get closer with more nodes") {
  if (!tests::hasAvsm()) return;
  for (const CurveReduction reduction : kReductions)
    for (const bool packed : {false, true}) {
      double last = 1;
      for (const int nodes : {4, 8, 12, 16}) {
        AvsmRig rig(configOf(reduction, kTexels, nodes, packed));
        captureSmoke(rig);
        double sum = 0;
        for (int i = 0; i < kTexels * kTexels; ++i) {
          const Curve curve = rig.curve(texelOf(i));
          const std::vector<reference::Segment> segments = smoke(i);
          checkShape(curve);
          CHECK(curve.front().y == 1);
          CHECK(curve.back().y == Approx(reference::transmittanceAt(segments, 1)).margin(packed ? 1e-4 : 2e-6));
          sum += tests::curveError(curve, segments) / (kTexels * kTexels);
        }
        CAPTURE(static_cast<int>(reduction), nodes, packed, sum);
        CHECK(sum < last);
        last = sum;
      }
    }
}

TEST_CASE("avsm: fitted curves are nearly as near as whole ones, and nearer than the paper's insertion") {
  if (!tests::hasAvsm()) return;
  for (const int nodes : {4, 8, 12, 16}) {
    std::map<CurveReduction, double> errors;
    for (const CurveReduction reduction :
         {CurveReduction::Fitted, CurveReduction::WholeCurve, CurveReduction::InOrder}) {
      AvsmRig rig(configOf(reduction, kTexels, nodes));
      captureSmoke(rig);
      for (int i = 0; i < kTexels * kTexels; ++i)
        errors[reduction] += tests::curveError(rig.curve(texelOf(i)), smoke(i));
    }
    CAPTURE(nodes, errors[CurveReduction::WholeCurve], errors[CurveReduction::InOrder]);
    CHECK(errors[CurveReduction::Fitted] < 1.3 * errors[CurveReduction::WholeCurve]);
    CHECK(errors[CurveReduction::Fitted] < 0.8 * errors[CurveReduction::InOrder]);
  }
}

TEST_CASE("avsm: the order of drawing moves a fitted curve by less than it is off") {
  if (!tests::hasAvsm()) return;
  constexpr int kDepths = 256;
  std::map<CurveReduction, double> moved, errors;
  for (const CurveReduction reduction : {CurveReduction::Fitted, CurveReduction::InOrder}) {
    AvsmRig rig(configOf(reduction, 2 * kTexels));
    std::vector<Captured> all;
    std::mt19937 random(11);
    for (int i = 0; i < kTexels * kTexels; ++i)
      for (int order = 0; order < 2; ++order) {
        std::vector<reference::Segment> segments = smoke(i);
        std::shuffle(segments.begin(), segments.end(), random);
        for (const Captured& s : atTexel(segments, {i % kTexels, i / kTexels + order * kTexels, 0}))
          all.push_back(s);
      }
    rig.capture(all); // the memory grows
    rig.capture(all);
    REQUIRE(rig.avsm().statistics().lost == 0);
    for (int i = 0; i < kTexels * kTexels; ++i) {
      const Curve one = rig.curve(texelOf(i)), other = rig.curve({i % kTexels, i / kTexels + kTexels, 0});
      for (int k = 0; k < kDepths; ++k) {
        const double depth = (k + 0.5) / kDepths, truth = reference::transmittanceAt(smoke(i), depth);
        moved[reduction] += std::abs(tests::curveAt(one, depth) - tests::curveAt(other, depth));
        errors[reduction] += std::abs(tests::curveAt(one, depth) - truth);
      }
    }
  }
  CAPTURE(errors[CurveReduction::Fitted], errors[CurveReduction::InOrder], moved[CurveReduction::InOrder]);
  CHECK(moved[CurveReduction::Fitted] < 0.7 * errors[CurveReduction::Fitted]);
  CHECK(moved[CurveReduction::Fitted] < 0.6 * moved[CurveReduction::InOrder]);
}

TEST_CASE("avsm: a fitted curve with room for all ends holds them, in any order") {
  if (!tests::hasAvsm()) return;
  constexpr double kBend = 1e-3; // of an even segment's exponential, which another one's end finds as a line
  // Two ends each: up to four segments are kept as they are; eight are all there when the fitting begins.
  for (const int count : {1, 2, 4, 8}) {
    std::vector<reference::Segment> segments = smoke(3);
    std::mt19937 random(7);
    std::shuffle(segments.begin(), segments.end(), random);
    segments.resize(static_cast<std::size_t>(count));
    AvsmRig rig(configOf(CurveReduction::Fitted, 4));
    std::vector<Captured> all = atTexel(segments, {0, 0, 0});
    std::shuffle(segments.begin(), segments.end(), random);
    for (const Captured& s : atTexel(segments, {1, 0, 0}))
      all.push_back(s);
    rig.capture(all);
    const Curve curve = rig.curve({0, 0, 0}), other = rig.curve({1, 0, 0});
    CAPTURE(count);
    for (std::size_t i = 0; i < curve.size(); ++i) {
      CHECK(other[i].x == Approx(curve[i].x).margin(1e-6));
      CHECK(other[i].y == Approx(curve[i].y).margin(kBend));
    }
    if (count > 4) continue;
    for (const reference::Segment& s : segments)
      for (const double depth : {s.entry, s.exit})
        CHECK(tests::curveAt(curve, depth) == Approx(reference::transmittanceAt(segments, depth)).margin(kBend));
  }
}

TEST_CASE("avsm: a thick even segment falls as an exponential, not along a line") {
  if (!tests::hasAvsm()) return;
  for (const CurveReduction reduction : {CurveReduction::Fitted, CurveReduction::WholeCurve})
    for (const double passed : {0.5, 0.2, 0.05, 1e-3}) {
      AvsmRig rig(configOf(reduction, 4));
      const std::vector<reference::Segment> segments = {{0.25, 0.75, passed}};
      rig.capture(atTexel(segments, {2, 1, 0}));
      const Curve curve = rig.curve({2, 1, 0});
      CAPTURE(static_cast<int>(reduction), passed);
      checkShape(curve);
      for (const double depth : {0.3, 0.4, 0.5, 0.6, 0.7})
        CHECK(tests::curveAt(curve, depth) == Approx(reference::transmittanceAt(segments, depth)).margin(0.02));
      CHECK(curve.back().y == Approx(passed).epsilon(1e-4));
    }
}

TEST_CASE("avsm: as many segments in one texel as a list may hold, in any order") {
  if (!tests::hasAvsm()) return;
  constexpr int kCount = 4096;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<reference::Segment> segments;
  for (int i = 0; i < kCount; ++i) {
    const double entry = std::pow(uniform(random), 2);
    segments.push_back({entry, std::min(entry + 0.05 * uniform(random), 1.0), std::exp(-6 * uniform(random) / kCount)});
  }
  std::vector<Captured> all = atTexel(segments, {1, 1, 0});
  std::shuffle(segments.begin(), segments.end(), random);
  for (const Captured& s : atTexel(segments, {6, 1, 0}))
    all.push_back(s);
  for (const CurveReduction reduction : {CurveReduction::WholeCurve, CurveReduction::Sorted}) {
    AvsmRig rig(configOf(reduction, 8));
    rig.capture(all);
    rig.capture(all);
    CAPTURE(static_cast<int>(reduction));
    CHECK(rig.avsm().statistics().lost == 0);
    const Curve curve = rig.curve({1, 1, 0});
    checkShape(curve);
    CHECK(tests::curveError(curve, segments) < (reduction == CurveReduction::WholeCurve ? 0.01 : 0.03));
    CHECK(curve.back().y == Approx(reference::transmittanceAt(segments, 1)).margin(1e-4));
    CHECK(rig.curve({6, 1, 0}) == curve);
  }
}
