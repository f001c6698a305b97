// Mistakes that integrators make: each is named by an error or a warning. And what is right is warned of nowhere.
#include "GlState.h"
#include "ShaftRig.h"

#include "gl/ReadBack.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;

namespace {

constexpr LightKind kSun = LightKind::Directional, kLamp = LightKind::Point, kSpot = LightKind::Spot;

// How a mistake is answered: at once, by an error or a warning, or by a warning once pixels have been looked at.
enum class Answer { Error, Warning, Pixels };

struct Mistake {
  std::string name;
  LightKind kind;
  std::function<void(tests::ShaftRig&)> make;
  Answer answer;
  std::vector<std::string> words; ///< of the line
};

Frame& frameOf(tests::ShaftRig& rig) { return rig.scene.frame; }
Light& lightOf(tests::ShaftRig& rig) { return rig.scene.frame.lights[0]; }

glm::dmat4 of(const Mat4& m) { return reference::toMat4(m); }

// Changes a matrix by one on its left or right.
void multiply(Mat4& m, const glm::dmat4& left) { m = tests::toMat4(left * of(m)); }
void transpose(Mat4& m) { m = tests::toMat4(glm::transpose(of(m))); }
void invert(Mat4& m) { m = tests::toMat4(glm::inverse(of(m))); }

void forViews(tests::ShaftRig& rig, const std::function<void(Mat4&)>& change) {
  for (ShadowView& view : lightOf(rig).shadow.views)
    change(view.clipFromWorld);
}

// From [-1, 1] to [0, 1], as shaders that sample shadow maps want it.
const glm::dmat4 kBias = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
// Into the upper left of four tiles.
const glm::dmat4 kTile = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-0.5, 0.5, 0)), glm::dvec3(0.5, 0.5, 1));

// The projection with planes that the depth does not have; depth stays.
void setPlanes(tests::ShaftRig& rig, double near, bool reversed = true, bool infinite = true,
               ClipDepth clipDepth = ClipDepth::ZeroToOne) {
  tests::DepthConvention other = rig.scene.convention();
  other.near = near;
  other.reversed = reversed;
  other.infinite = infinite;
  other.clipDepth = clipDepth;
  frameOf(rig).camera.clipFromView = other.clipFromView(0.5, 1.5);
}

// The rig with a standard depth from -1 to 1, as OpenGL has it unless told otherwise.
void useOldDepth(tests::ShaftRig& rig) {
  tests::DepthConvention old;
  old.near = 0.25;
  old.far = 60;
  rig.setConvention(old);
}

void fillDepth(tests::ShaftRig& rig, float value) {
  rig.scene.setDepth(std::vector<float>(rig.scene.depth().size(), value));
}

void fillMap(tests::ShaftRig& rig, float value) {
  reference::ShadowImage image = rig.scene.shadow(0);
  std::fill(image.depth.begin(), image.depth.end(), value);
  rig.scene.setShadow(0, image);
}

void scaleMedium(tests::ShaftRig& rig, float factor) {
  for (float& s : frameOf(rig).medium.constituents[0].scattering)
    s *= factor;
}

const std::vector<Mistake> kMistakes = {
    // The camera.
    {"a view matrix by rows",
     kSun,
     [](auto& rig) { transpose(frameOf(rig).camera.viewFromWorld); },
     Answer::Error,
     {"camera.viewFromWorld is not affine"}},
    {"the camera's pose in place of its inverse",
     kSun,
     [](auto& rig) { invert(frameOf(rig).camera.viewFromWorld); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"a projection by rows",
     kSun,
     [](auto& rig) { transpose(frameOf(rig).camera.clipFromView); },
     Answer::Error,
     {"camera.clipFromView has the last row", "transposed"}},
    {"viewFromClip",
     kSun,
     [](auto& rig) { invert(frameOf(rig).camera.clipFromView); },
     Answer::Error,
     {"camera.clipFromView has the last row", "inverse"}},
    {"view and projection in one, and the view again",
     kSun,
     [](auto& rig) {
       Camera& camera = frameOf(rig).camera;
       multiply(camera.viewFromWorld, glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 1, 0)));
       camera.clipFromView = tests::toMat4(of(camera.clipFromView) * of(camera.viewFromWorld));
     },
     Answer::Warning,
     {"camera.clipFromView has the last row", "view matrix"}},
    {"a near plane 18 times as far as depth has it",
     kSun,
     [](auto& rig) { setPlanes(rig, 18 * 0.05); },
     Answer::Pixels,
     {"lights[0].shadow", "near and far planes"}},
    {"a near plane 18 times as near as depth has it",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05 / 18); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"depth from 0 to 1, said to be from -1 to 1",
     kSun,
     [](auto& rig) { frameOf(rig).camera.clipDepth = ClipDepth::NegativeOneToOne; },
     Answer::Error,
     {"camera.clipDepth is NegativeOneToOne", "behind the eye"}},
    {"depth from -1 to 1, said to be from 0 to 1",
     kSun,
     [](auto& rig) {
       useOldDepth(rig);
       frameOf(rig).camera.clipDepth = ClipDepth::ZeroToOne;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"reversed depth from -1 to 1, said to be from 0 to 1",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05, true, true, ClipDepth::NegativeOneToOne); },
     Answer::Warning,
     {"camera.clipDepth is ZeroToOne", "times as far"}},
    {"reversed depth, and a projection that is not",
     kSun,
     [](auto& rig) { setPlanes(rig, 0.05, false, false); },
     Answer::Pixels,
     {"Frame::depth", "near plane"}},
    {"the aspect ratio of another window",
     kSun,
     [](auto& rig) { frameOf(rig).camera.clipFromView[0] *= 0.75; },
     Answer::Warning,
     {"camera.clipFromView", "times as wide"}},
    {"a jitter of the wrong sign",
     kSun,
     [](auto& rig) {
       Camera& camera = frameOf(rig).camera;
       camera.jitter = {0.25, -0.4};
       multiply(camera.clipFromView, glm::translate(glm::dmat4(1), glm::dvec3(-2 * 0.25 / 96, 2 * 0.4 / 64, 0)));
     },
     Answer::Warning,
     {"camera.jitter is (0.25, -0.4)", "(-0.25, 0.4) pixels"}},
    {"a picture upside down",
     kSun,
     [](auto& rig) { multiply(frameOf(rig).camera.clipFromView, glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1))); },
     Answer::Warning,
     {"lights[0].direction", "mirrored"}},
    {"depth that is cleared", kSun, [](auto& rig) { fillDepth(rig, 0); }, Answer::Pixels, {"lights[0].shadow", "sky"}},
    {"depth that is cleared to the near value",
     kSun,
     [](auto& rig) { fillDepth(rig, 1); },
     Answer::Pixels,
     {"Frame::depth", "near plane"}},
    {"depth that another camera saw",
     kSun,
     [](auto& rig) { frameOf(rig).camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1}); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // A sun.
    {"the direction to the sun",
     kSun,
     [](auto& rig) {
       for (double& x : lightOf(rig).direction)
         x = -x;
     },
     Answer::Warning,
     {"lights[0].direction", "points it to the sun"}},
    {"the sun of another hour",
     kSun,
     [](auto& rig) { lightOf(rig).direction = {0.6, -0.6, 1}; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view along", "lights[0].direction"}},
    {"a lamp's view for a sun",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.views = tests::shadowViews(tests::shaftLight(kSpot)); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a perspective view", "orthographic"}},
    {"a sun's shadow matrix by rows",
     kSun,
     [](auto& rig) { forViews(rig, transpose); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is transposed"}},
    {"a sun's shadow matrix, inverted",
     kSun,
     [](auto& rig) { forViews(rig, invert); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is the inverse, worldFromClip"}},
    {"a sun's shadow matrix for texture coordinates",
     kSun,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kBias); }); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"a sun's shadow matrix scaled to an atlas's tile",
     kSun,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kTile); }); },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"the coarsest cascade first",
     kSun,
     [](auto& rig) { std::swap(lightOf(rig).shadow.views[0], lightOf(rig).shadow.views[1]); },
     Answer::Warning,
     {"lights[0].shadow.views[1].clipFromWorld", "never looked at"}},
    {"one layer for two cascades",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.views[1].layer = 0; },
     Answer::Warning,
     {"lights[0].shadow.views[1].layer is 0", "that of views[0]"}},
    {"layers of other cascades",
     kSun,
     [](auto& rig) {
       for (ShadowView& view : lightOf(rig).shadow.views)
         view.layer = 1 - view.layer;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"a shadow map that nothing was drawn into",
     kSun,
     [](auto& rig) { fillMap(rig, 1); },
     Answer::Pixels,
     {"lights[0].shadow", "where the map has none"}},
    {"a shadow map that is all 0", kSun, [](auto& rig) { fillMap(rig, 0); }, Answer::Pixels, {"lights[0].shadow"}},
    {"a shadow map's clip depth",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.clipDepth = ClipDepth::ZeroToOne; },
     Answer::Pixels,
     {"lights[0].shadow"}},
    {"shadow matrices of another place of the camera",
     kSun,
     [](auto& rig) {
       forViews(rig, [](Mat4& m) { m = tests::toMat4(of(m) * glm::translate(glm::dmat4(1), glm::dvec3(2, 0, 1))); });
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // Lamps.
    {"a spot's place below its node, not in the world",
     kSpot,
     [](auto& rig) { lightOf(rig).position = {0, 0, 0}; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view from (-0.6, 6.4, -3.5)", "lights[0].position"}},
    {"a spot's shadow matrix by rows",
     kSpot,
     [](auto& rig) { forViews(rig, transpose); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is transposed"}},
    {"a spot's shadow matrix, inverted",
     kSpot,
     [](auto& rig) { forViews(rig, invert); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "it is the inverse"}},
    {"an orthographic view for a spot",
     kSpot,
     [](auto& rig) { lightOf(rig).shadow.views = tests::shadowViews(tests::shaftLight(kSun)); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is an orthographic view", "perspective"}},
    {"the direction to a spot",
     kSpot,
     [](auto& rig) {
       for (double& x : lightOf(rig).direction)
         x = -x;
     },
     Answer::Error,
     {"lights[0].direction", "outside of lights[0].shadow.views[0]"}},
    {"a cone's whole angle",
     kSpot,
     [](auto& rig) { lightOf(rig).outerConeAngle = 1.5; },
     Answer::Warning,
     {"lights[0].outerConeAngle is 1.5", "half angle"}},
    {"a cone in degrees",
     kSpot,
     [](auto& rig) { lightOf(rig).outerConeAngle = 45; },
     Answer::Error,
     {"lights[0].outerConeAngle is 45"}},
    {"a spot's shadow matrix for texture coordinates",
     kSpot,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, kBias); }); },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld", "(0.5, 0.5)"}},
    {"a spot's map upside down",
     kSpot,
     [](auto& rig) { forViews(rig, [](Mat4& m) { multiply(m, glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1))); }); },
     Answer::Warning,
     {"lights[0].shadow.views[0].clipFromWorld is mirrored"}},
    {"a range in other units",
     kSpot,
     [](auto& rig) { lightOf(rig).range = 0.06; },
     Answer::Warning,
     {"lights[0].range is 0.06", "near plane"}},
    {"one view of a point light",
     kLamp,
     [](auto& rig) { lightOf(rig).shadow.views.resize(1); },
     Answer::Warning,
     {"lights[0].shadow.views is 1 long", "all sides"}},
    {"a point light that has moved on",
     kLamp,
     [](auto& rig) { lightOf(rig).position[1] += 0.5; },
     Answer::Error,
     {"lights[0].shadow.views[0].clipFromWorld is a view from", "lights[0].position"}},
    {"a cube's faces in another order",
     kLamp,
     [](auto& rig) {
       for (ShadowView& view : lightOf(rig).shadow.views)
         view.layer = 5 - view.layer;
     },
     Answer::Pixels,
     {"lights[0].shadow"}},
    // The rest.
    {"views without a map",
     kSun,
     [](auto& rig) { lightOf(rig).shadow.texture = 0; },
     Answer::Warning,
     {"lights[0].shadow.texture is 0"}},
    {"the scene depth as a shadow map",
     kSpot,
     [](auto& rig) {
       lightOf(rig).shadow.array = false;
       lightOf(rig).shadow.texture = frameOf(rig).depth.texture;
     },
     Answer::Error,
     {"lights[0].shadow.texture is texture", "scene depth"}},
    {"a light that is black",
     kSun,
     [](auto& rig) { lightOf(rig).colour = {0, 0, 0}; },
     Answer::Warning,
     {"lights", "black"}},
    {"a medium that only absorbs",
     kSun,
     [](auto& rig) { scaleMedium(rig, 0); },
     Answer::Warning,
     {"medium.constituents", "no light is added"}},
    {"a medium per millimetre",
     kSun,
     [](auto& rig) { scaleMedium(rig, 1e4F); },
     Answer::Warning,
     {"medium is so thick"}},
    {"a medium per light year",
     kSun,
     [](auto& rig) { scaleMedium(rig, 1e-9F); },
     Answer::Warning,
     {"medium is so thin"}},
    {"a sky at the eye",
     kSun,
     [](auto& rig) { frameOf(rig).medium.farDistance = 0.01; },
     Answer::Warning,
     {"medium.farDistance is 0.01", "near plane"}},
};

// A rig whose depth and maps show one scene.
tests::ShaftRig rightRig(LightKind kind) {
  tests::ShaftRig rig;
  rig.look(tests::lookAt({0.5, 2, 1}, {-0.4, 1.6, -4}));
  Light light = tests::shaftLight(kind);
  light.shadow.views = tests::shadowViews(light, 2);
  rig.addLight(light);
  frameOf(rig).settings.technique = Technique::Epipolar;
  return rig;
}

// The frame's status, and its warnings once pixels have been looked at.
struct Outcome {
  Status status;
  std::vector<std::string> warnings;

  bool names(const std::vector<std::string>& words) const {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& line) {
      return std::all_of(words.begin(), words.end(),
                         [&](const std::string& word) { return line.find(word) != std::string::npos; });
    });
  }
};

Outcome render(Effect& effect, const Frame& frame, int frames = 3) {
  Outcome outcome;
  for (int i = 0; i < frames && outcome.status; ++i) {
    outcome.status = effect.render(frame);
    gl().Finish();
  }
  outcome.warnings = effect.statistics().warnings;
  return outcome;
}

std::unique_ptr<Effect> checkingEffect(bool warningsAreErrors = false) {
  Config config;
  config.checkInputs = true;
  config.warningsAreErrors = warningsAreErrors;
  return tests::newEffect(config);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines)
    all += line + "\n";
  return all;
}

void checkRight(tests::ShaftRig& rig) {
  const auto effect = checkingEffect();
  const Outcome outcome = render(*effect, frameOf(rig));
  INFO(outcome.status.message << joined(outcome.warnings));
  CHECK(outcome.status);
  CHECK(outcome.warnings.empty());
}

} // namespace

TEST_CASE("mistakes that integrators make are each named by an error or a warning") {
  for (const Mistake& mistake : kMistakes) {
    CAPTURE(mistake.name);
    tests::ShaftRig rig = rightRig(mistake.kind);
    mistake.make(rig);
    // What fields say is known at the first frame, and without a look at pixels.
    const auto effect = mistake.answer == Answer::Pixels ? checkingEffect() : tests::newEffect();
    const Outcome outcome = render(*effect, frameOf(rig), mistake.answer == Answer::Pixels ? 3 : 1);
    CAPTURE(outcome.status.message, joined(outcome.warnings));
    if (mistake.answer == Answer::Error) {
      CHECK(outcome.status.code == StatusCode::InvalidFrame);
      CHECK(Outcome{{}, {outcome.status.message}}.names(mistake.words));
    } else {
      CHECK(outcome.status);
      CHECK(outcome.names(mistake.words));
    }
  }
}

TEST_CASE("right inputs are warned of nowhere: lights, conventions, cameras") {
  for (const LightKind kind : {kSun, kLamp, kSpot}) {
    CAPTURE(static_cast<int>(kind));
    tests::ShaftRig rig = rightRig(kind);
    for (const bool reversed : {false, true})
      for (const bool infinite : {false, true})
        for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
          CAPTURE(reversed, infinite, static_cast<int>(clipDepth));
          tests::DepthConvention convention;
          convention.reversed = reversed;
          convention.infinite = infinite;
          convention.clipDepth = clipDepth;
          convention.near = 0.1;
          rig.setConvention(convention);
          checkRight(rig);
        }
    for (const glm::dvec3& target : {glm::dvec3(5, 2, 0), glm::dvec3(0.1, 30, 0), glm::dvec3(-2, 0, -1),
                                     glm::dvec3(0, 2, 9), glm::dvec3(-7, 6.5, -7)}) {
      CAPTURE(target.x, target.y, target.z);
      rig.look(tests::lookAt({0, 2, 0}, target));
      checkRight(rig);
    }
  }
}

TEST_CASE("right inputs are warned of nowhere: an orthographic camera, and one in full shadow") {
  tests::ShaftRig rig = rightRig(kSun);
  tests::DepthConvention convention;
  convention.orthographic = true;
  convention.near = 0.1;
  rig.setConvention(convention);
  checkRight(rig);
  tests::ShaftRig roofed = rightRig(kSun); // below a roof that shades all that is seen
  roofed.setMoving({glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(-5, 9, -30)), glm::dvec3(60, 0.1, 60))});
  checkRight(roofed);
}

TEST_CASE("exact takes views that are elsewhere than their light, and warns") {
  tests::ShaftRig rig = rightRig(kSpot);
  lightOf(rig).position[0] += 0.4;
  frameOf(rig).settings.technique = Technique::Exact;
  const auto effect = tests::newEffect();
  const Outcome exact = render(*effect, frameOf(rig), 1);
  CHECK(exact.status);
  CHECK(exact.names({"lights[0].shadow.views[0].clipFromWorld is a view from", "lights[0].position"}));
  frameOf(rig).settings.technique = Technique::Tree;
  CHECK(effect->render(frameOf(rig)).code == StatusCode::InvalidFrame);
}

TEST_CASE("warnings that are errors draw nothing, and end with what they are about") {
  for (const bool ofPixels : {false, true}) {
    CAPTURE(ofPixels);
    tests::ShaftRig rig = rightRig(kSun);
    const Frame right = frameOf(rig);
    const std::vector<float> before(4 * 96 * 64, 0.25F);
    const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, before);
    Frame wrong = frameOf(rig);
    if (ofPixels)
      wrong.camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1});
    else
      wrong.lights[0].shadow.views[1].layer = 0;
    const auto effect = checkingEffect(true);
    if (ofPixels) CHECK(effect->render(wrong)); // not known yet
    gl().Finish();
    for (int i = 0; i < 3; ++i) {
      gl().BindTexture(GL_TEXTURE_2D, colour.name());
      gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 96, 64, GL_RGBA, GL_FLOAT, before.data());
      const Status status = effect->render(wrong);
      gl().Finish();
      INFO(status.message);
      CHECK(status.code == StatusCode::InvalidFrame);
      CHECK(status.message.rfind("Frame::lights[0].shadow", 0) == 0);
      CHECK(tests::bitEqual(host::readColour(colour.name(), 96, 64), before));
    }
    for (int i = 0; i < 2; ++i) { // the first of them still knows of the wrong ones
      effect->render(right);
      gl().Finish();
    }
    CHECK(effect->render(right));
    CHECK(effect->statistics().warnings.empty());
  }
}

TEST_CASE("inputs that are not to be checked cost no program, no pass and no memory") {
  tests::ShaftRig rig = rightRig(kSun);
  const auto plain = tests::newEffect(), checking = checkingEffect();
  const Outcome without = render(*plain, frameOf(rig)), with = render(*checking, frameOf(rig));
  REQUIRE(without.status);
  const Statistics a = plain->statistics(), b = checking->statistics();
  const auto isCheck = [](const PassStatistics& pass) { return pass.name.find("check") != std::string::npos; };
  CHECK(std::none_of(a.passes.begin(), a.passes.end(), isCheck));
  CHECK(std::count_if(b.passes.begin(), b.passes.end(), isCheck) == 1);
  CHECK(b.passes.size() == a.passes.size() + 1);
  CHECK(b.compiledPrograms == a.compiledPrograms + 1);
  CHECK(b.bytes > a.bytes);
  CHECK(rig.scene.render(*plain).inscatter == rig.scene.render(*checking).inscatter);
}

TEST_CASE("checks of inputs leave a poisoned GL state alone, and nothing of what is gone") {
  tests::ShaftRig rig = rightRig(kSun);
  Frame wrong = frameOf(rig);
  wrong.camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1});
  const auto effect = checkingEffect();
  for (int i = 0; i < 4; ++i) {
    const tests::Poison poison;
    const tests::GlState before = tests::captureGlState();
    const Status status = effect->render(wrong);
    const tests::GlState after = tests::captureGlState();
    tests::Poison::lift();
    gl().Finish();
    INFO(status.message);
    CHECK(status);
    for (const auto& [name, values] : before) {
      INFO(name);
      CHECK(values == after.at(name));
    }
  }
  CHECK_FALSE(effect->statistics().warnings.empty());
  wrong.lights.clear();
  CHECK(effect->render(wrong));
  CHECK(effect->render(wrong));
  CHECK(effect->statistics().warnings.empty());
}

TEST_CASE("the view of inputs tells lit, shadowed and impossible surfaces apart") {
  tests::ShaftRig rig = rightRig(kSun);
  const auto magenta = [&] {
    const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, std::vector<float>(4 * 96 * 64, 0));
    frameOf(rig).settings.debugView = DebugView::Inputs;
    REQUIRE(tests::testEffect().render(frameOf(rig)));
    const std::vector<float> rgba = host::readColour(colour.name(), 96, 64);
    frameOf(rig).colour = 0;
    int count = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4)
      count += rgba[i] > 0.4F && rgba[i + 2] == rgba[i] && rgba[i + 1] == 0 ? 1 : 0;
    return count;
  };
  CHECK(magenta() < 96 * 64 / 100);
  frameOf(rig).camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1});
  CHECK(magenta() > 96 * 64 / 20);
}
