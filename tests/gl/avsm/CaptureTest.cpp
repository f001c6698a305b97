// What avsmCapture records, and what it leaves out.
#include "AvsmRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace tyndall;
using tests::AvsmRig;
using tests::Captured;
using tests::checkNear;
using tests::configOf;
using tests::Curve;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr CurveReduction kReductions[] = {CurveReduction::Fitted, CurveReduction::WholeCurve, CurveReduction::Sorted,
                                          CurveReduction::InOrder};

// A segment, and what it lets through up to 0, 0.5 and 1.
struct Odd {
  float entry, exit, transmittance;
  double passed[3];
};

const double kHalf = std::sqrt(0.25);
const Odd kOdd[] = {
    {0.7F, 0.3F, 0.25F, {1, kHalf, 0.25}},                              // the exit comes first
    {0.4F, 0.4F, 0.5F, {1, 0.5, 0.5}},                                  // no length
    {0.2F, 0.3F, 0, {1, 0, 0}},                                         // opaque
    {0.2F, 0.3F, -3, {1, 0, 0}},                                        // more than opaque
    {0.2F, 0.3F, -kInf, {1, 0, 0}},                                     //
    {0.2F, 0.3F, 1, {1, 1, 1}},                                         // nothing
    {0.2F, 0.3F, 1.5F, {1, 1, 1}},                                      // less than nothing
    {0.2F, 0.3F, kInf, {1, 1, 1}},                                      //
    {0.2F, 0.3F, kNaN, {1, 1, 1}},                                      // no number
    {kNaN, 0.3F, 0.5F, {1, 1, 1}},                                      //
    {0.2F, kNaN, 0.5F, {1, 1, 1}},                                      //
    {-kInf, 0.3F, 0.5F, {1, 1, 1}},                                     // not finite
    {0.2F, kInf, 0.5F, {1, 1, 1}},                                      //
    {0.2F, -kInf, 0.5F, {1, 1, 1}},                                     //
    {-kInf, kInf, 0.5F, {1, 1, 1}},                                     //
    {3e38F, -3e38F, 0.5F, {1, 1, 1}},                                   //
    {-2, -1, 0.5F, {0.5, 0.5, 0.5}},                                    // in front of the near plane
    {-0.0F, -0.0F, 0.5F, {0.5, 0.5, 0.5}},                              // at it
    {-0.25F, 0.5F, 0.5F, {1, 0.5, 0.5}},                                // across it
    {1.25F, 1.5F, 0.5F, {1, 1, 1}},                                     // behind the far plane
    {0.75F, 1.25F, 0.25F, {1, 1, kHalf}},                               // across it: density kept
    {0.5F, 1.5F, 0.0F, {1, 1, 0}},                                      //
    {0.0F, 2.0F, 0.0625F, {1, kHalf, 0.25}},                            //
    {1, 2, 0.5F, {1, 1, 1}},                                            // from it on
    {1, 2, 0, {1, 1, 1}},                                               //
    {1, 1, 0.5F, {1, 1, 0.5}},                                          // at it
    {-1, 2, 0.5F, {1, std::pow(0.5, 1.0 / 3), std::pow(0.5, 2.0 / 3)}}, // all of the map and more
};

// All segments of smoke that a texel may have, alike for each call.
std::vector<Captured> puffs(std::mt19937& random, const glm::ivec3& texel, int count) {
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Captured> all;
  for (int i = 0; i < count; ++i) {
    const float at = uniform(random), passed = 0.99F - 0.1F * uniform(random);
    all.push_back({texel, at, at + 0.05F * uniform(random), passed});
  }
  return all;
}

std::vector<Captured> puffsEverywhere(int size, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Captured> all;
  for (int i = 0; i < size * size; ++i) {
    const std::vector<Captured> some = puffs(random, {i % size, i / size, 0}, count);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

// Segments of one texel that are thin and have no length, from the light on.
std::vector<Captured> steps(int count, float transmittance) {
  std::vector<Captured> all;
  for (int i = 0; i < count; ++i) {
    const float at = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    all.push_back({{0, 0, 0}, at, at, transmittance});
  }
  return all;
}

} // namespace

TEST_CASE("avsm: whatever a segment's values are, it dims what is defined and nothing else") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 6;
  for (const CurveReduction reduction : kReductions) {
    AvsmRig rig(configOf(reduction, kSize));
    std::vector<Captured> segments;
    std::vector<glm::ivec3> texels;
    std::vector<float> depths;
    std::vector<double> expected;
    for (std::size_t i = 0; i < std::size(kOdd); ++i) {
      const glm::ivec3 texel(static_cast<int>(i) % kSize, static_cast<int>(i) / kSize, 0);
      segments.push_back({texel, kOdd[i].entry, kOdd[i].exit, kOdd[i].transmittance});
      for (int k = 0; k < 3; ++k) {
        texels.push_back(texel);
        depths.push_back(0.5F * static_cast<float>(k));
        expected.push_back(kOdd[i].passed[k]);
      }
    }
    rig.capture(segments);
    const std::vector<float> found = rig.lookUp(texels, depths, true);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Odd& odd = kOdd[i / 3];
      CAPTURE(static_cast<int>(reduction), odd.entry, odd.exit, odd.transmittance, depths[i]);
      // Lines that are fitted to the exponential are not laid through it.
      const bool isFitted = reduction == CurveReduction::WholeCurve || reduction == CurveReduction::Fitted;
      CHECK(found[i] == Approx(expected[i]).margin(isFitted && depths[i] == 0.5F ? 6e-3 : 3e-4));
    }
  }
}

TEST_CASE("avsm: texels outside the map are left out") {
  if (!tests::hasAvsm()) return;
  AvsmConfig config = configOf(CurveReduction::WholeCurve, 4);
  config.layers = 2;
  AvsmRig rig(config);
  std::vector<Captured> segments;
  for (const glm::ivec3& texel :
       {glm::ivec3(-1, 0, 0), glm::ivec3(0, -1, 0), glm::ivec3(0, 0, -1), glm::ivec3(4, 0, 0), glm::ivec3(0, 4, 1),
        glm::ivec3(0, 0, 2), glm::ivec3(INT32_MAX), glm::ivec3(INT32_MIN)})
    segments.push_back({texel, 0.25F, 0.5F, 0.5F});
  rig.capture(segments);
  CHECK(rig.avsm().statistics().segments == 0);
  CHECK(rig.avsm().curves().texture == 0);
  segments.push_back({{3, 3, 1}, 0.25F, 0.5F, 0.5F});
  rig.capture(segments);
  CHECK(rig.avsm().statistics().segments == 1);
  for (int layer = 0; layer < 2; ++layer)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        CHECK(rig.curve({x, y, layer}).back().y == Approx(x == 3 && y == 3 && layer == 1 ? 0.5 : 1));
}

TEST_CASE("avsm: every segment on one texel leaves the shallowest that a list can hold") {
  if (!tests::hasAvsm()) return;
  constexpr int kSegments = 20000, kHeld = 4096;
  constexpr float kPassed = 0.9995F;
  std::vector<Captured> all = steps(kSegments, kPassed);
  std::shuffle(all.begin(), all.end(), std::mt19937(1));
  for (const CurveReduction reduction : kReductions) {
    AvsmRig rig(configOf(reduction, 1, 16));
    rig.capture(all); // the memory grows
    rig.capture(all);
    CAPTURE(static_cast<int>(reduction));
    const AvsmStatistics statistics = rig.avsm().statistics();
    CHECK(statistics.segments == kSegments);
    CHECK(statistics.lost == kSegments - kHeld);
    const Curve curve = rig.curve({0, 0, 0});
    CHECK(curve.back().y == Approx(std::pow(kPassed, kHeld)).epsilon(1e-3));
    // None that is kept lies behind those, but for what arrived while the list became full.
    CHECK(curve.back().x == Approx(static_cast<double>(kHeld) / kSegments).margin(0.01));
    if (reduction == CurveReduction::InOrder) continue;
    for (const double depth : {0.05, 0.1, 0.2, 0.5})
      CHECK(tests::curveAt(curve, depth) ==
            Approx(std::pow(kPassed, std::min(depth * kSegments, double{kHeld}))).margin(0.02));
  }
}

TEST_CASE("avsm: without memory one segment per texel is kept, the shallowest") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 16;
  const std::vector<Captured> all = puffsEverywhere(kSize, 40, 5);
  for (const CurveReduction reduction : kReductions) {
    AvsmConfig config = configOf(reduction, kSize, 4);
    config.mostListBytes = 0;
    AvsmRig rig(config);
    for (int frame = 0; frame < 3; ++frame) {
      rig.capture(all);
      const AvsmStatistics statistics = rig.avsm().statistics();
      CHECK(statistics.segments == all.size());
      CHECK(statistics.lost == all.size() - kSize * kSize);
      CHECK(statistics.listBytes < 64 + kSize * kSize * 40);
    }
    for (std::size_t texel = 0; texel < kSize * kSize; ++texel) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(40 * texel);
      const Captured& kept =
          *std::min_element(first, first + 40, [](const Captured& a, const Captured& b) { return a.entry < b.entry; });
      const Curve curve = rig.curve(kept.texel);
      CAPTURE(texel, static_cast<int>(reduction));
      CHECK(curve.front().x == Approx(kept.entry).margin(1e-6));
      CHECK(curve.back().x == Approx(kept.exit).margin(1e-6));
      CHECK(curve.back().y == Approx(kept.transmittance).margin(1e-6));
    }
  }
}

TEST_CASE("avsm: an overflow keeps the shallowest of each list, is told, and the next frame has room") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8, kPerTexel = 60;
  std::vector<Captured> all = puffsEverywhere(kSize, kPerTexel, 9);
  std::shuffle(all.begin(), all.end(), std::mt19937(2));
  AvsmRig small(configOf(CurveReduction::Sorted, kSize)), large(configOf(CurveReduction::Sorted, kSize));
  small.capture(all); // the first frame has room for 10 segments per texel besides the first
  const AvsmStatistics first = small.avsm().statistics();
  CHECK(first.segments == all.size());
  CHECK(first.lost == all.size() - kSize * kSize * 11);
  for (int i = 0; i < kSize * kSize; ++i) {
    const Curve curve = small.curve({i % kSize, i / kSize, 0});
    double depth = 0, passed = 1;
    for (const glm::dvec2& node : curve) {
      CHECK(node.x >= depth);
      CHECK(node.y <= passed + 1e-6);
      CHECK(node.y > 0);
      depth = node.x;
      passed = node.y;
    }
    float shallowest = 1;
    for (const Captured& s : all)
      if (s.texel == glm::ivec3(i % kSize, i / kSize, 0)) shallowest = std::min(shallowest, s.entry);
    CHECK(curve.front().x == Approx(shallowest).margin(1e-6));
  }
  small.capture(all);
  CHECK(small.avsm().statistics().lost == 0);
  CHECK(small.avsm().statistics().listBytes > first.listBytes);
  large.capture(all);
  large.capture(all);
  CHECK(small.bits() == large.bits());
}

TEST_CASE("avsm: memory grows with need and is kept afterwards") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8;
  AvsmRig rig(configOf(CurveReduction::WholeCurve, kSize));
  CHECK(rig.avsm().statistics().listBytes == 0);
  std::uint64_t bytes = 0;
  for (const int count : {2, 20, 40, 80}) {
    const std::vector<Captured> all = puffsEverywhere(kSize, count, 3);
    rig.capture(all);
    rig.capture(all);
    const AvsmStatistics statistics = rig.avsm().statistics();
    CHECK(statistics.lost == 0);
    CHECK(statistics.listBytes >= bytes);
    CHECK(statistics.listBytes <= 2 * 36 * std::max<std::size_t>(all.size(), 11 * kSize * kSize));
    bytes = statistics.listBytes;
  }
  for (const int count : {80, 1, 40, 0, 80}) {
    rig.capture(puffsEverywhere(kSize, count, 3));
    CHECK(rig.avsm().statistics().lost == 0);
    CHECK(rig.avsm().statistics().listBytes == bytes);
  }
}

TEST_CASE("avsm: two million segments, three hundred in a texel") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 82, kPerTexel = 300;
  std::vector<Captured> all = puffsEverywhere(kSize, kPerTexel, 4);
  for (Captured& s : all)
    s.transmittance = 1 - 0.1F * (1 - s.transmittance); // so that light is left
  AvsmRig rig(configOf(CurveReduction::WholeCurve, kSize));
  rig.capture(all);
  CHECK(rig.avsm().statistics().segments == all.size());
  rig.capture(all);
  CHECK(rig.avsm().statistics().segments == all.size());
  CHECK(rig.avsm().statistics().lost == 0);
  for (const int texel : {0, 1234, kSize * kSize - 1}) {
    std::vector<reference::Segment> segments;
    for (int i = 0; i < kPerTexel; ++i) {
      const Captured& s = all[static_cast<std::size_t>(texel * kPerTexel + i)];
      const double inMap = s.exit > 1 ? (1.0 - s.entry) / (static_cast<double>(s.exit) - s.entry) : 1;
      segments.push_back({s.entry, std::min(double{s.exit}, 1.0), std::pow(s.transmittance, inMap)});
    }
    CHECK(tests::curveError(rig.curve({texel % kSize, texel / kSize, 0}), segments) < 0.004);
  }
}

TEST_CASE("avsm: curves are the same bit for bit in fifty frames, and in any order of drawing") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 8;
  for (const CurveReduction reduction : {CurveReduction::WholeCurve, CurveReduction::Sorted})
    for (const bool packed : {false, true}) {
      AvsmRig rig(configOf(reduction, kSize, 8, packed));
      std::vector<Captured> all = puffsEverywhere(kSize, 30, 6);
      rig.capture(all);
      rig.capture(all);
      const std::vector<std::uint32_t> first = rig.bits();
      std::mt19937 random(7);
      for (int frame = 0; frame < 50; ++frame) {
        if (frame >= 25) std::shuffle(all.begin(), all.end(), random);
        rig.capture(all);
        CAPTURE(static_cast<int>(reduction), packed, frame);
        CHECK(rig.bits() == first);
      }
    }
}

TEST_CASE("avsm: insertion in the order of drawing is the same in fifty frames for the same order") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(CurveReduction::InOrder, 1));
  std::mt19937 random(8);
  const std::vector<Captured> all = puffs(random, {0, 0, 0}, 8); // of one work group: no other order is possible
  rig.capture(all);
  const Curve first = rig.curve({0, 0, 0});
  for (int frame = 0; frame < 50; ++frame) {
    rig.capture(all);
    checkNear(rig.curve({0, 0, 0}), first, 0);
  }
}

TEST_CASE("avsm: frames without a segment have no curves, before and after smoke") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(CurveReduction::WholeCurve, 4));
  const std::vector<Captured> smoke = {{{1, 1, 0}, 0.25F, 0.5F, 0.5F}};
  std::uint64_t version = rig.avsm().curves().version;
  CHECK(rig.avsm().curves().texture == 0);
  for (int round = 0; round < 3; ++round) {
    for (int frame = 0; frame < 2; ++frame) {
      rig.capture({});
      if (frame > 0 || round == 0)
        CHECK(rig.avsm().curves().texture == 0);
      else if (rig.avsm().curves().texture != 0)
        CHECK(rig.curve({1, 1, 0}).back().y == 1); // not known yet
      CHECK(rig.avsm().statistics().segments == 0);
      CHECK(rig.avsm().curves().version > version);
      version = rig.avsm().curves().version;
    }
    REQUIRE(rig.avsm().statistics().passes.size() == 1);
    CHECK(rig.avsm().statistics().passes[0].skipped == "no segment was captured");
    for (int frame = 0; frame < 3; ++frame) {
      rig.capture(smoke);
      CHECK(rig.avsm().curves().version > version);
      version = rig.avsm().curves().version;
      CHECK(rig.curve({1, 1, 0}).back().y == Approx(0.5));
      CHECK(rig.curve({2, 1, 0}).back().y == 1);
    }
  }
}
