// avsmInsert: segments inserted by an engine's own shaders, in the order of drawing, against captured lists.
#include "AvsmRig.h"
#include "gl/effect/GlState.h"
#include "support/Catch.h"

#include <random>

using namespace tyndall;
using host::gl;
using tests::AvsmRig;
using tests::Captured;
using tests::checkNear;
using tests::Curve;

namespace {

constexpr int kSize = 4;

AvsmConfig configOf(int nodes, bool packed) {
  AvsmConfig config;
  config.size = kSize;
  config.layers = 2;
  config.nodes = nodes;
  config.packed = packed;
  config.reduction = CurveReduction::InOrder;
  return config;
}

bool hasFetch() {
  if (!tests::hasAvsm()) return false;
  if (tests::hasExtension("GL_EXT_shader_framebuffer_fetch")) return true;
  WARN("skipped: the context has no GL_EXT_shader_framebuffer_fetch");
  return false;
}

std::vector<Captured> puffs(int count, const glm::ivec3& texel, float thinnest = 0.9F) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<Captured> all;
  for (int i = 0; i < count; ++i) {
    const float at = uniform(random) * 1.1F - 0.05F;
    all.push_back({texel, at, at + (i % 5 == 0 ? 0 : 0.1F * uniform(random)), thinnest + 0.05F * uniform(random)});
  }
  return all;
}

// A triangle over the whole map for each segment, into all texels of the layer.
void drawSegments(Avsm& avsm, const std::vector<Captured>& segments, const char* version) {
  const AvsmCurves curves = avsm.curves();
  const std::string fragment =
      std::string(version) + "#extension GL_EXT_shader_framebuffer_fetch : require\n#define TYNDALL_CURVE_NODES " +
      std::to_string(curves.nodes) + "\n#define TYNDALL_CURVE_PACKED " + (curves.packed ? "1\n" : "0\n") +
      avsmInsertSource() + "uniform vec3 segment;\nvoid main() { tyndallInsert(segment.x, segment.y, segment.z); }\n";
  const std::string vertex = std::string(version) +
                             "void main() {\n"
                             "  gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);\n}\n";
  host::Program program("insert", vertex.c_str(), fragment.c_str());
  const host::GlVertexArray empty = host::makeVertexArray();
  gl().BindVertexArray(empty.name());
  gl().Viewport(0, 0, kSize, kSize);
  program.use();
  for (const Captured& s : segments) {
    program.set("segment", glm::vec3(s.entry, s.exit, s.transmittance));
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl().BindVertexArray(0);
  gl().UseProgram(0);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
}

// The curve that a list in the same order has.
Curve listed(int nodes, bool packed, const std::vector<Captured>& segments) {
  AvsmRig rig(configOf(nodes, packed));
  for (int frame = 0; frame < 2; ++frame) { // the memory grows
    tests::captureLastFirst(rig.avsm(), segments);
    REQUIRE(rig.avsm().resolve());
    gl().Finish();
  }
  CHECK(rig.avsm().statistics().lost == 0);
  return rig.curve(segments[0].texel);
}

} // namespace

TEST_CASE("avsm insert: fragments that read the framebuffer make the curve of a list in the same order") {
  if (!hasFetch()) return;
  for (const char* version : {"#version 330 core\n", "#version 430 core\n"})
    for (const int nodes : {4, 8, 12, 16}) {
      const std::vector<Captured> segments = puffs(100, {1, 2, 1});
      AvsmRig rig(configOf(nodes, false));
      REQUIRE(rig.avsm().beginStreaming());
      REQUIRE(rig.avsm().bindCurves(1));
      CHECK(gl().CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
      drawSegments(rig.avsm(), segments, version);
      REQUIRE(rig.avsm().resolve());
      CAPTURE(version, nodes);
      const Curve expected = listed(nodes, false, segments);
      for (const glm::ivec2& texel : {glm::ivec2(0, 0), glm::ivec2(1, 2), glm::ivec2(3, 3)}) {
        checkNear(rig.curve({texel, 1}), expected, 1e-6);
        CHECK(rig.curve({texel, 0}).front() == glm::dvec2(1));
      }
    }
}

TEST_CASE("avsm insert: packed curves are those of lists but for the rounding of each segment") {
  if (!hasFetch()) return;
  for (const int nodes : {4, 8, 12, 16}) {
    // As many segments as there are nodes for, so that the rounding does not change which nodes are removed.
    const std::vector<Captured> segments = puffs(nodes / 2, {1, 2, 1}, 0.6F);
    AvsmRig rig(configOf(nodes, true));
    REQUIRE(rig.avsm().beginStreaming());
    REQUIRE(rig.avsm().bindCurves(1));
    drawSegments(rig.avsm(), segments, "#version 330 core\n");
    REQUIRE(rig.avsm().resolve());
    CAPTURE(nodes);
    checkNear(rig.curve({1, 2, 1}), listed(nodes, true, segments), nodes / 65535.0);
    const std::vector<Captured> many = puffs(100, {1, 2, 1});
    REQUIRE(rig.avsm().beginStreaming());
    REQUIRE(rig.avsm().bindCurves(1));
    drawSegments(rig.avsm(), many, "#version 330 core\n");
    REQUIRE(rig.avsm().resolve());
    CHECK(rig.curve({1, 2, 1}).back().y == Approx(listed(nodes, true, many).back().y).margin(100 / 65535.0));
  }
}

TEST_CASE("avsm insert: by an image, where one invocation owns a texel") {
  if (!tests::hasAvsm()) return;
  for (const int nodes : {4, 8, 12, 16}) {
    const std::vector<Captured> segments = puffs(100, {1, 2, 1});
    std::vector<Captured> all = segments;
    for (const glm::ivec3& outside :
         {glm::ivec3(-1, 0, 0), glm::ivec3(4, 0, 0), glm::ivec3(0, 4, 0), glm::ivec3(0, 0, 2)})
      all.push_back({outside, 0.2F, 0.3F, 0.5F});
    AvsmRig rig(configOf(nodes, false)), packed(configOf(nodes, true));
    for (AvsmRig* each : {&rig, &packed}) {
      REQUIRE(each->avsm().beginStreaming());
      tests::insertByImage(each->avsm(), all);
      REQUIRE(each->avsm().resolve());
      CHECK(each->avsm().statistics().segments == 0);
    }
    CAPTURE(nodes);
    checkNear(rig.curve({1, 2, 1}), listed(nodes, false, segments), 1e-6);
    CHECK(packed.curve({1, 2, 1}).back().y == Approx(rig.curve({1, 2, 1}).back().y).margin(100 / 65535.0));
    for (const glm::ivec3& other : {glm::ivec3(0, 0, 0), glm::ivec3(1, 2, 0), glm::ivec3(3, 3, 1)})
      CHECK(rig.curve(other).front() == glm::dvec2(1));
  }
}

TEST_CASE("avsm insert: capture and streaming in turn, and calls out of order") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(8, false));
  const std::vector<Captured> segments = puffs(20, {1, 2, 1});
  CHECK(rig.avsm().bindCurves(0).code == StatusCode::InvalidFrame);
  for (int round = 0; round < 2; ++round) {
    REQUIRE(rig.avsm().beginStreaming());
    CHECK(rig.avsm().curves().texture != 0);
    for (const int layer : {-1, 2}) {
      const Status status = rig.avsm().bindCurves(layer);
      CHECK(status.code == StatusCode::InvalidFrame);
      CHECK(status.message.find("layer is " + std::to_string(layer)) != std::string::npos);
    }
    tests::insertByImage(rig.avsm(), segments);
    const std::uint64_t version = rig.avsm().curves().version;
    CHECK(rig.avsm().resolve());
    CHECK(rig.avsm().curves().version > version);
    CHECK(rig.curve({1, 2, 1}).back().y < 0.9);
    CHECK_FALSE(rig.avsm().resolve());
    CHECK(rig.avsm().bindCurves(0).code == StatusCode::InvalidFrame);
    rig.capture({});
    CHECK(rig.avsm().curves().texture == 0);
    rig.capture(segments);
    CHECK(rig.avsm().statistics().segments > 0);
    CHECK(rig.curve({1, 2, 1}).back().y < 0.9);
    REQUIRE(rig.avsm().beginStreaming()); // empties
    CHECK(rig.avsm().resolve());
    CHECK(rig.curve({1, 2, 1}).front() == glm::dvec2(1));
    rig.capture({});
    rig.capture({});
  }
}

TEST_CASE("avsm insert: binding curves changes the draw framebuffer alone") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(16, false));
  REQUIRE(rig.avsm().beginStreaming());
  Status bound;
  tests::GlState before, after;
  {
    const tests::Poison poison;
    before = tests::captureGlState();
    bound = rig.avsm().bindCurves(1);
    after = tests::captureGlState();
    tests::Poison::lift();
  }
  CHECK(bound);
  CHECK(after.at("draw framebuffer") != before.at("draw framebuffer"));
  for (const auto& [name, values] : before) {
    CAPTURE(name);
    if (name != "draw framebuffer") CHECK(after.at(name) == values);
  }
}
