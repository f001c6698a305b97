// Every rule about a frame's numbers: a valid frame with one field broken is refused with field, value and rule.
#include "RefusalRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

using namespace tyndall;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinusInfinity = -kInfinity;

// A field of one or several numbers, the values that it must refuse, and a word of its rule.
struct NumberRule {
  std::string field;
  int components;
  std::function<void(Frame&, int component, double value)> set;
  std::vector<double> refused;
  std::string rule;
};

template <typename Array>
void put(Array& array, int index, double value) {
  array[static_cast<std::size_t>(index)] = static_cast<typename Array::value_type>(value);
}

const std::vector<double> kNotFinite = {kNan, kInfinity, kMinusInfinity};
const std::vector<double> kNotFiniteOrNegative = {kNan, kInfinity, kMinusInfinity, -1, -1e-30};

const std::vector<NumberRule> kNumberRules = {
    {"viewport.width",
     1,
     [](Frame& f, int, double v) { f.viewport.width = static_cast<int>(v); },
     {0, -1, 16385, 2e9},
     "1 to 16384"},
    {"viewport.height",
     1,
     [](Frame& f, int, double v) { f.viewport.height = static_cast<int>(v); },
     {0, -1, 16385, 2e9},
     "1 to 16384"},
    {"camera.viewFromWorld", 16, [](Frame& f, int i, double v) { put(f.camera.viewFromWorld, i, v); }, kNotFinite,
     "finite"},
    {"camera.clipFromView", 16, [](Frame& f, int i, double v) { put(f.camera.clipFromView, i, v); }, kNotFinite,
     "finite"},
    {"camera.jitter",
     2,
     [](Frame& f, int i, double v) { put(f.camera.jitter, i, v); },
     {kNan, kInfinity, kMinusInfinity, 16.001, -17, 1000},
     "at most 16 pixels"},
    {"lights[0].colour", 3, [](Frame& f, int i, double v) { put(f.lights[0].colour, i, v); }, kNotFiniteOrNegative,
     "finite and >= 0"},
    {"lights[2].colour", 3, [](Frame& f, int i, double v) { put(f.lights[2].colour, i, v); }, kNotFiniteOrNegative,
     "finite and >= 0"},
    {"lights[0].direction", 3, [](Frame& f, int i, double v) { put(f.lights[0].direction, i, v); }, kNotFinite,
     "finite and not 0"},
    {"lights[2].direction", 3, [](Frame& f, int i, double v) { put(f.lights[2].direction, i, v); }, kNotFinite,
     "finite and not 0"},
    {"lights[1].position", 3, [](Frame& f, int i, double v) { put(f.lights[1].position, i, v); }, kNotFinite, "finite"},
    {"lights[2].position", 3, [](Frame& f, int i, double v) { put(f.lights[2].position, i, v); }, kNotFinite, "finite"},
    {"lights[1].range",
     1,
     [](Frame& f, int, double v) { f.lights[1].range = v; },
     {kNan, 0, -1, kMinusInfinity},
     "> 0"},
    {"lights[2].range",
     1,
     [](Frame& f, int, double v) { f.lights[2].range = v; },
     {kNan, 0, -1, kMinusInfinity},
     "> 0"},
    {"lights[2].outerConeAngle",
     1,
     [](Frame& f, int, double v) { f.lights[2].outerConeAngle = v; },
     {kNan, 0, -0.5, 1.5708, kInfinity},
     "> 0 and <= pi/2"},
    {"lights[2].innerConeAngle",
     1,
     [](Frame& f, int, double v) { f.lights[2].innerConeAngle = v; },
     {kNan, -1e-9, 0.601, kInfinity},
     ">= 0 and <= outerConeAngle"},
    {"lights[0].boundary.point", 3,
     [](Frame& f, int i, double v) {
       f.lights[0].boundary.enabled = true;
       put(f.lights[0].boundary.point, i, v);
     },
     kNotFinite, "finite"},
    {"lights[0].boundary.normal", 3,
     [](Frame& f, int i, double v) {
       f.lights[0].boundary.enabled = true;
       put(f.lights[0].boundary.normal, i, v);
     },
     kNotFinite, "finite and not 0"},
    {"lights[0].shadow.views[1].clipFromWorld", 16,
     [](Frame& f, int i, double v) { put(f.lights[0].shadow.views[1].clipFromWorld, i, v); }, kNotFinite, "finite"},
    {"lights[1].shadow.views[5].clipFromWorld", 16,
     [](Frame& f, int i, double v) { put(f.lights[1].shadow.views[5].clipFromWorld, i, v); }, kNotFinite, "finite"},
    {"lights[0].shadow.views[0].layer",
     1,
     [](Frame& f, int, double v) { f.lights[0].shadow.views[0].layer = static_cast<int>(v); },
     {-1, 2, 1000},
     "layer"},
    {"lights[2].shadow.views[0].layer",
     1,
     [](Frame& f, int, double v) { f.lights[2].shadow.views[0].layer = static_cast<int>(v); },
     {-1, 1},
     "must be 0"},
    {"medium.constituents[1].scattering", 3,
     [](Frame& f, int i, double v) { put(f.medium.constituents[1].scattering, i, v); }, kNotFiniteOrNegative,
     "finite and >= 0"},
    {"medium.constituents[0].g",
     1,
     [](Frame& f, int, double v) { f.medium.constituents[0].g = static_cast<float>(v); },
     {kNan, 1, -1, 2, kInfinity},
     "between -1 and 1"},
    {"medium.absorption", 3, [](Frame& f, int i, double v) { put(f.medium.absorption, i, v); }, kNotFiniteOrNegative,
     "finite and >= 0"},
    {"medium.layers[1].height", 1,
     [](Frame& f, int, double v) {
       f.medium.layers.resize(2);
       f.medium.layers[1].height = v;
     },
     kNotFinite, "finite"},
    {"medium.layers[0].scale",
     1,
     [](Frame& f, int, double v) { f.medium.layers = {{0, v}}; },
     {kNan, 0, -1, kMinusInfinity},
     "> 0"},
    {"medium.layers[0].ground",
     1,
     [](Frame& f, int, double v) { f.medium.layers = {{0, 1, v}}; },
     {kNan, kInfinity},
     "finite, or -infinity"},
    {"medium.up", 3,
     [](Frame& f, int i, double v) {
       f.medium.layers.resize(1);
       put(f.medium.up, i, v);
     },
     kNotFinite, "finite and not 0"},
    {"medium.constituents[1].layer",
     1,
     [](Frame& f, int, double v) { f.medium.constituents[1].layer = static_cast<int>(v); },
     {-2, 0, 1},
     "one of the 0"},
    {"medium.absorptionLayer",
     1,
     [](Frame& f, int, double v) {
       f.medium.layers.resize(2);
       f.medium.absorptionLayer = static_cast<int>(v);
     },
     {-2, 2},
     "one of the 2"},
    {"ambient.radiance", 3,
     [](Frame& f, int i, double v) { f.ambient.radiance[static_cast<std::size_t>(i)] = static_cast<float>(v); },
     kNotFiniteOrNegative, "finite and >= 0"},
    {"ambient.harmonics[7]", 3,
     [](Frame& f, int i, double v) { f.ambient.harmonics[7][static_cast<std::size_t>(i)] = static_cast<float>(v); },
     kNotFinite, "must be finite"},
    {"lights[0].scatteringScale", 1,
     [](Frame& f, int, double v) { f.lights[0].scatteringScale = static_cast<float>(v); }, kNotFiniteOrNegative,
     "finite and >= 0"},
    {"medium.farDistance",
     1,
     [](Frame& f, int, double v) { f.medium.farDistance = v; },
     {kNan, 0, -1, kMinusInfinity},
     "> 0"},
};

// Anything else that one change breaks.
struct Breakage {
  std::string name;
  std::function<void(Frame&)> apply;
  std::vector<std::string> words;
};

template <typename Enum>
void setEnum(Enum& field, int value) {
  field = static_cast<Enum>(value);
}

const std::vector<Breakage> kBreakages = {
    {"nothing to write",
     [](Frame& f) {
       f.colour = 0;
       f.output = {};
     },
     {"Frame::colour is 0", "output"}},
    {"singular view",
     [](Frame& f) { f.camera.viewFromWorld[0] = f.camera.viewFromWorld[1] = f.camera.viewFromWorld[2] = 0; },
     {"camera.viewFromWorld is singular", "invertible"}},
    {"all-zero view",
     [](Frame& f) { f.camera.viewFromWorld = {}; },
     {"camera.viewFromWorld is singular", "invertible"}},
    {"projective view",
     [](Frame& f) { f.camera.viewFromWorld[3] = 0.1; },
     {"camera.viewFromWorld is not affine", "(0, 0, 0, 1)"}},
    {"scaled view",
     [](Frame& f) { f.camera.viewFromWorld[15] = 2; },
     {"camera.viewFromWorld is not affine", "(0, 0, 0, 1)"}},
    {"singular projection",
     [](Frame& f) { f.camera.clipFromView[5] = 0; },
     {"camera.clipFromView is singular", "invertible"}},
    {"projection of rank 1",
     [](Frame& f) { f.camera.clipFromView.fill(1); },
     {"camera.clipFromView is singular", "invertible"}},
    {"clip depth", [](Frame& f) { setEnum(f.camera.clipDepth, 2); }, {"camera.clipDepth is 2", "enumerators"}},
    {"17 lights", [](Frame& f) { f.lights.resize(17); }, {"lights is 17 long", "at most 16"}},
    {"light kind 3", [](Frame& f) { setEnum(f.lights[1].kind, 3); }, {"lights[1].kind is 3", "enumerators"}},
    {"light kind -1", [](Frame& f) { setEnum(f.lights[1].kind, -1); }, {"lights[1].kind is -1", "enumerators"}},
    {"no direction",
     [](Frame& f) { f.lights[0].direction = {0, 0, 0}; },
     {"lights[0].direction is (0, 0, 0)", "not 0"}},
    {"no spot direction", [](Frame& f) { f.lights[2].direction = {0, -0.0, 0}; }, {"lights[2].direction", "not 0"}},
    {"boundary of a point light",
     [](Frame& f) { f.lights[1].boundary.enabled = true; },
     {"lights[1].boundary.enabled", "directional"}},
    {"boundary without normal",
     [](Frame& f) { f.lights[0].boundary = {true, {0, 0, 0}, {0, 0, 0}}; },
     {"lights[0].boundary.normal is (0, 0, 0)", "not 0"}},
    {"boundary along the light",
     [](Frame& f) { f.lights[0].boundary = {true, {0, 0, 0}, {1, 0.4, 0}}; },
     {"lights[0].boundary.normal", "parallel"}},
    {"no views", [](Frame& f) { f.lights[0].shadow.views.clear(); }, {"lights[0].shadow.views is 0 long", "1 to 4"}},
    {"5 cascades",
     [](Frame& f) { f.lights[0].shadow.views.resize(5); },
     {"lights[0].shadow.views is 5 long", "1 to 4"}},
    {"a fade of more than half a cascade",
     [](Frame& f) { f.lights[0].cascadeFade = 0.51; },
     {"lights[0].cascadeFade is 0.51", "0 to 0.5"}},
    {"a fade that is not a number",
     [](Frame& f) { f.lights[0].cascadeFade = kNan; },
     {"lights[0].cascadeFade is nan", "0 to 0.5"}},
    {"a negative fade",
     [](Frame& f) { f.lights[0].cascadeFade = -0.1; },
     {"lights[0].cascadeFade is -0.1", "0 to 0.5"}},
    {"a fade of a point light",
     [](Frame& f) { f.lights[1].cascadeFade = 0.1; },
     {"lights[1].cascadeFade is 0.1", "directional"}},
    {"several views without an array",
     [](Frame& f) {
       f.lights[0].shadow.array = false;
       f.lights[0].shadow.views.resize(2);
     },
     {"lights[0].shadow.array is false", "several views need a GL_TEXTURE_2D_ARRAY"}},
    {"7 faces", [](Frame& f) { f.lights[1].shadow.views.resize(7); }, {"lights[1].shadow.views is 7 long", "1 to 6"}},
    {"2 spot views",
     [](Frame& f) { f.lights[2].shadow.views.resize(2); },
     {"lights[2].shadow.views is 2 long", "has 1"}},
    {"singular shadow view",
     [](Frame& f) { f.lights[1].shadow.views[3].clipFromWorld = {}; },
     {"lights[1].shadow.views[3].clipFromWorld is singular", "invertible"}},
    {"shadow clip depth",
     [](Frame& f) { setEnum(f.lights[0].shadow.clipDepth, -1); },
     {"lights[0].shadow.clipDepth is -1", "enumerators"}},
    {"glass without depth", [](Frame& f) { f.lights[0].glass.depth = 0; }, {"lights[0].glass.depth is 0", "both"}},
    {"glass without colour", [](Frame& f) { f.lights[0].glass.colour = 0; }, {"lights[0].glass.colour is 0", "both"}},
    {"glass without shadow map",
     [](Frame& f) { f.lights[2].shadow.texture = 0; },
     {"lights[2].shadow.texture is 0", "glass map needs a shadow map"}},
    {"5 constituents",
     [](Frame& f) { f.medium.constituents.resize(5); },
     {"medium.constituents is 5 long", "at most 4"}},
    {"3 layers", [](Frame& f) { f.medium.layers.resize(3); }, {"medium.layers is 3 long", "at most 2"}},
    {"no up",
     [](Frame& f) {
       f.medium.layers.resize(1);
       f.medium.up = {0, 0, 0};
     },
     {"medium.up", "not 0"}},
    {"phase 4",
     [](Frame& f) { setEnum(f.medium.constituents[1].phase, 4); },
     {"medium.constituents[1].phase is 4", "enumerators"}},
    {"phase -1",
     [](Frame& f) { setEnum(f.medium.constituents[0].phase, -1); },
     {"medium.constituents[0].phase is -1", "enumerators"}},
    {"technique", [](Frame& f) { setEnum(f.settings.technique, 99); }, {"settings.technique is 99", "enumerators"}},
    {"view", [](Frame& f) { setEnum(f.settings.debugView, 12); }, {"settings.debugView is 12", "enumerators"}},
    {"view below", [](Frame& f) { setEnum(f.settings.debugView, -1); }, {"settings.debugView is -1", "enumerators"}},
    {"slices of exact",
     [](Frame& f) { f.settings.debugView = DebugView::Slices; },
     {"settings.debugView is Slices", "technique Tree, LowRank or Epipolar"}},
    {"fix-up pixels of exact",
     [](Frame& f) { f.settings.debugView = DebugView::FixupPixels; },
     {"settings.debugView is FixupPixels", "technique Tree, LowRank or Epipolar"}},
    {"samples of tree",
     [](Frame& f) {
       f.settings.technique = Technique::Tree;
       f.settings.debugView = DebugView::MarchSamples;
     },
     {"settings.debugView is MarchSamples", "technique Epipolar"}},
    {"view without colour",
     [](Frame& f) {
       f.colour = 0;
       f.settings.debugView = DebugView::Inscatter;
     },
     {"settings.debugView is Inscatter", "Frame::colour"}},
    {"filter", [](Frame& f) { setEnum(f.settings.shadowFilter, 2); }, {"settings.shadowFilter is 2", "enumerators"}},
};

} // namespace

TEST_CASE("a frame with a number that breaks its rule is refused, field and rule named") {
  tests::RefusalRig rig;
  rig.checkAccepted(rig.frame);
  for (const NumberRule& rule : kNumberRules)
    for (int component = 0; component < rule.components; ++component)
      for (const double value : rule.refused) {
        CAPTURE(rule.field, component, value);
        Frame broken = rig.frame;
        rule.set(broken, component, value);
        std::vector<std::string> words = {"Frame::" + rule.field + " is ", rule.rule};
        if (std::abs(value) < 1e6 && value == std::floor(value))
          words.push_back(std::to_string(static_cast<int>(value)));
        rig.checkRefused(broken, words);
      }
  rig.checkAccepted(rig.frame);
}

TEST_CASE("a frame with a broken list, matrix, enumerator or combination is refused, field and rule named") {
  tests::RefusalRig rig;
  for (const Breakage& breakage : kBreakages) {
    CAPTURE(breakage.name);
    Frame broken = rig.frame;
    breakage.apply(broken);
    rig.checkRefused(broken, breakage.words);
  }
  rig.checkAccepted(rig.frame);
}

TEST_CASE("fields that a light does not use may hold anything") {
  tests::RefusalRig rig;
  rig.checkAccepted(rig.frame);
  const std::vector<float> before = host::readColour(rig.frame.output.inscatter, 8, 8);
  Frame frame = rig.frame;
  frame.lights[0].position = {kNan, kNan, kNan};
  frame.lights[0].range = -1;
  frame.lights[0].outerConeAngle = frame.lights[1].outerConeAngle = kNan;
  frame.lights[0].innerConeAngle = frame.lights[1].innerConeAngle = -3;
  frame.lights[1].direction = {kNan, 0, 0};
  frame.lights[1].boundary.normal = {kNan, 0, 0};
  frame.lights[2].boundary.point = {kInfinity, 0, 0};
  rig.checkAccepted(frame);
  CHECK(tests::bitEqual(host::readColour(rig.frame.output.inscatter, 8, 8), before));
}

TEST_CASE("the ends of every range are accepted") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  frame.lights[2].outerConeAngle = 1.5707963267948966;
  frame.lights[2].innerConeAngle = frame.lights[2].outerConeAngle;
  frame.lights[1].range = 1e-300;
  frame.medium.farDistance = 1e-300;
  frame.medium.constituents.resize(4);
  frame.medium.constituents[2] = {{0.1F, 0.1F, 0.1F}, Phase::HenyeyGreenstein, 0.999F};
  frame.medium.constituents[3] = {{0.1F, 0.1F, 0.1F}, Phase::CornetteShanks, -0.999F};
  frame.lights[0].shadow.views.resize(4, frame.lights[0].shadow.views[0]);
  while (frame.lights.size() < 16)
    frame.lights.emplace_back();
  rig.checkAccepted(frame);
}

TEST_CASE("a view matrix that a general inverse has rounded is accepted") {
  tests::RefusalRig rig;
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 eye(1.3 * i, 7 - 0.9 * i, 100.7 + i);
    // A camera below a scaled node, as scene graphs have it.
    const glm::mat4 worldFromView =
        glm::mat4(glm::scale(glm::dmat4(1), glm::dvec3(0.01 * (i + 1))) *
                  glm::inverse(glm::lookAt(eye, glm::dvec3(0.3, 0, 0), glm::dvec3(0, 1, 0))));
    const glm::mat4 viewFromWorld = glm::inverse(worldFromView);
    Frame frame = rig.frame;
    frame.camera.viewFromWorld = mat4(&viewFromWorld[0][0]);
    CAPTURE(frame.camera.viewFromWorld[3], frame.camera.viewFromWorld[7], frame.camera.viewFromWorld[11],
            frame.camera.viewFromWorld[15] - 1);
    rig.checkAccepted(frame);
  }
}
