// The rivals of adaptive volumetric shadow maps against answers that are known, so that none is compared with while
// broken.
#include "Judge.h"
#include "Methods.h"
#include "reference/Curves.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <algorithm>
#include <cmath>

using namespace avsmbench;

namespace {

bool hasCompute() {
  if (tests::testContext().glVersion() >= 43) return true;
  WARN("skipped: the context is older than OpenGL 4.3");
  return false;
}

/// A scene, and what methods make of it.
class Rig {
public:
  explicit Rig(const MapScene& scene) : stage_(scene) {
    config_.loader = tests::testContext().loader();
    config_.size = scene.size;
    lists_ = tyndall::Avsm::create(config_).avsm;
    REQUIRE(lists_);
  }

  std::vector<float> answers(const std::string& name, const std::vector<Query>& queries) {
    method_ = methodNamed(name).make(*lists_, config_);
    stage_.captureAll(method_->lists());
    method_->build();
    return stage_.answers(*method_, queries);
  }

  const Method& method() const { return *method_; } ///< that was asked last

private:
  Stage stage_;
  tyndall::AvsmConfig config_;
  std::unique_ptr<tyndall::Avsm> lists_;
  MethodPointer method_;
};

std::vector<Query> depthsOf(std::uint32_t texel, int count) {
  std::vector<Query> queries;
  for (int i = 0; i <= count; ++i)
    queries.push_back({texel, static_cast<float>(i) / static_cast<float>(count)});
  return queries;
}

MapScene sceneOf(std::vector<DrawnSegment> segments) { return {"test", 8, std::move(segments)}; }

bool keepsTheEnd(const std::string& name) { return name.rfind("moments", 0) != 0; }

} // namespace

TEST_CASE(
    "avsm bench: of one segment every method has what passes in front of it and behind it, and leaves others alone") {
  if (!hasCompute()) return;
  Rig rig(sceneOf({{10, 0.4F, 0.6F, 0.5F}}));
  for (const MethodEntry& entry : allMethods()) {
    const std::vector<float> found =
        rig.answers(entry.name, {{10, 0.05F}, {10, 0.5F}, {10, 0.95F}, {10, 1}, {11, 0.5F}, {11, 1}, {2, 0.9F}});
    CAPTURE(entry.name);
    const bool blurred = entry.name.rfind("moments", 0) == 0 || entry.name == kBaseline;
    CHECK(found[0] == Approx(1).margin(blurred ? 0.02 : 1e-6));
    // A line instead of the exponential between two nodes is 0.043 too high in the middle.
    CHECK(found[1] == Approx(std::sqrt(0.5)).margin(blurred ? 0.08 : 0.045));
    CHECK(found[2] == Approx(0.5).margin(blurred ? 0.02 : 0.011));
    if (keepsTheEnd(entry.name)) CHECK(found[3] == Approx(0.5).margin(entry.name == "deep 0.01" ? 0.0101 : 0.0021));
    CHECK(found[4] == 1);
    CHECK(found[5] == 1);
    CHECK(found[6] == 1);
  }
}

TEST_CASE("avsm bench: an even medium from end to end is an exponential, of which Fourier's series has one term") {
  if (!hasCompute()) return;
  Rig rig(sceneOf({{63, 0, 1, 0.2F}}));
  const std::vector<Query> queries = depthsOf(63, 64);
  for (const auto& [name, margin] :
       {std::pair("lists", 1e-5), std::pair("opacity 32", 1e-5), std::pair("fourier 16", 1e-5),
        std::pair("deep 0.002", 0.006), std::pair("deep 0.01", 0.014), std::pair("moments 4", 0.15),
        std::pair("moments 6", 0.15)}) {
    const std::vector<float> found = rig.answers(name, queries);
    CAPTURE(name);
    double worst = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
      worst = std::max(worst,
                       std::abs(static_cast<double>(found[i]) - std::pow(0.2, static_cast<double>(queries[i].depth))));
    CHECK(worst < margin);
  }
}

TEST_CASE("avsm bench: moments know as many steps as half their number") {
  if (!hasCompute()) return;
  Rig rig(sceneOf({{0, 0.2F, 0.2F, 0.6F},
                   {0, 0.7F, 0.7F, 0.3F},
                   {1, 0.2F, 0.2F, 0.6F},
                   {1, 0.5F, 0.5F, 0.7F},
                   {1, 0.8F, 0.8F, 0.3F}}));
  const std::vector<Query> queries = {{0, 0.1F}, {0, 0.45F}, {0, 0.9F}, {1, 0.1F}, {1, 0.35F}, {1, 0.65F}, {1, 0.95F}};
  const std::vector<double> expected = {1, 0.6, 0.18, 1, 0.6, 0.42, 0.126};
  for (const auto& [name, known] : {std::pair("moments 4", 3), std::pair("moments 6", 7)}) {
    const std::vector<float> found = rig.answers(name, queries);
    for (std::size_t i = 0; i < static_cast<std::size_t>(known); ++i) {
      CAPTURE(name, i);
      CHECK(found[i] == Approx(expected[i]).margin(0.01));
    }
  }
}

TEST_CASE("avsm bench: deep maps stay within their threshold, whatever the curve, with fewer nodes than ends") {
  if (!hasCompute()) return;
  for (const char* name : {"smoke", "hair", "hair-tenth"}) {
    const MapScene scene = makeMapScene(name, 8);
    Rig rig(scene);
    const auto segments = segmentsByTexel(scene);
    std::vector<Query> queries;
    for (std::uint32_t texel = 0; texel < segments.size(); ++texel)
      for (const Query& query : depthsOf(texel, 200))
        queries.push_back(query);
    for (const auto& [method, threshold] : {std::pair("deep 0.002", 0.002), std::pair("deep 0.01", 0.01)}) {
      const std::vector<float> found = rig.answers(method, queries);
      double worst = 0;
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const double truth =
            reference::transmittanceAt(segments[queries[i].texel], static_cast<double>(queries[i].depth));
        worst = std::max(worst, std::abs(static_cast<double>(found[i]) - truth));
      }
      CAPTURE(name, method);
      // Lines in place of exponentials add an eighth of the square of a quarter of optical depth.
      CHECK(worst < threshold + 0.008);
      CHECK(rig.method().bytes() < 8 * (64 + 2 * scene.segments.size()));
    }
  }
}

TEST_CASE("avsm bench: the lists are the product, and all methods end at it") {
  if (!hasCompute()) return;
  const MapScene scene = makeMapScene("hair", 32);
  Rig rig(scene);
  const Judge judge(scene);
  CHECK(judge.meanError(rig.answers("lists", judge.queries())) < 1e-6);
  const auto segments = segmentsByTexel(scene);
  std::vector<Query> queries;
  for (std::uint32_t texel = 0; texel < segments.size(); ++texel)
    queries.push_back({texel, 1});
  for (const MethodEntry& entry : allMethods()) {
    if (!keepsTheEnd(entry.name)) continue;
    const std::vector<float> found = rig.answers(entry.name, queries);
    double worst = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(found[i]) - reference::transmittanceAt(segments[i], 1)));
    CAPTURE(entry.name);
    CHECK(worst < (entry.name.rfind("deep", 0) == 0 ? 0.011 : 1e-3));
  }
}

TEST_CASE("avsm bench: smoke and hair have as many segments as scenes that people draw") {
  for (const std::string& name : mapSceneNames()) {
    const MapScene scene = makeMapScene(name, 256);
    std::size_t most = 0;
    for (const auto& texel : segmentsByTexel(scene))
      most = std::max(most, texel.size());
    CAPTURE(name, most);
    const double mean = static_cast<double>(scene.segments.size()) / (256 * 256);
    CHECK(mean > 20);
    CHECK(mean < 60);
    CHECK(most > 120);
    CHECK(most < 350);
    const auto [low, high] = std::minmax_element(scene.segments.begin(), scene.segments.end(),
                                                 [](const auto& a, const auto& b) { return a.entry < b.entry; });
    const bool isTenth = name.find("tenth") != std::string::npos;
    CHECK(low->entry >= (isTenth ? 0.45F : 0.0F));
    CHECK(high->entry <= (isTenth ? 0.5501F : 1.0F));
  }
}
