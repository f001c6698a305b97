// Mistakes that integrators make: each is named by an error or a warning. And what is right is warned of nowhere.
#include "Mistakes.h"
#include "GlState.h"
#include "MapLayoutRig.h"

#include "gl/ReadBack.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;
using tests::Answer;
using tests::Mistake;
using tests::rightRig;

namespace {

constexpr LightKind kSun = LightKind::Directional, kLamp = LightKind::Point, kSpot = LightKind::Spot;

Frame& frameOf(tests::ShaftRig& rig) { return rig.scene.frame; }
Light& lightOf(tests::ShaftRig& rig) { return rig.scene.frame.lights[0]; }

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
  for (const Mistake& mistake : tests::mistakes()) {
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

TEST_CASE("right inputs are warned of nowhere: lights, conventions, cameras", "[sweep]") {
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

// As engines focus maps on what the camera sees: less than the cone, and beside its axis.
TEST_CASE("a spot's view of what the camera sees of its cone is right, of less is warned of, of nothing refused") {
  tests::ShaftRig rig = rightRig(kSpot);
  Frame& frame = frameOf(rig);
  Light& lamp = lightOf(rig);
  const glm::dmat4 whole = reference::toMat4(lamp.shadow.views[0].clipFromWorld);
  const glm::dvec3 position(lamp.position[0], lamp.position[1], lamp.position[2]);
  const auto focus = [&](double x, double y) { // on a tenth of the picture
    const glm::dmat4 part =
        glm::scale(glm::dmat4(1), glm::dvec3(10, 10, 1)) * glm::translate(glm::dmat4(1), glm::dvec3(-x, -y, 0));
    lamp.shadow.views[0].clipFromWorld = tests::toMat4(part * whole);
    const glm::dvec4 middle = glm::inverse(whole) * glm::dvec4(x, y, 0.5, 1);
    return glm::dvec3(middle) / middle.w;
  };
  const tyndall::Mat4 wide = frame.camera.clipFromView;
  const auto look = [&](const glm::dvec3& target, double zoom) {
    rig.look(tests::lookAt(position + 0.1 * (target - position), target));
    frame.camera.clipFromView =
        tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(zoom, zoom, 1)) * reference::toMat4(wide));
  };
  const auto effect = tests::newEffect();
  for (const glm::dvec2& part : {glm::dvec2(0.45, 0), glm::dvec2(0, -0.45), glm::dvec2(0.25, 0.3)}) {
    CAPTURE(part.x, part.y);
    const glm::dvec3 target = focus(part.x, part.y);
    look(target, 30);
    const Outcome focused = render(*effect, frame, 1);
    CAPTURE(focused.status.message, joined(focused.warnings));
    CHECK(focused.status);
    CHECK(focused.warnings.empty());
    look(target, 1);
    const Outcome less = render(*effect, frame, 1);
    CHECK(less.status);
    CHECK(less.names({"lights[0].outerConeAngle", "reaches out of lights[0].shadow.views[0]"}));
  }
  focus(1.6, 1.6);
  const Outcome nothing = render(*effect, frame, 1);
  CHECK(nothing.status.code == StatusCode::InvalidFrame);
  CHECK(nothing.status.message.find("all of the cone is outside") != std::string::npos);
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

TEST_CASE("mistakes in atlases and cube maps are called what they are") {
  using Places = std::vector<ShadowView>;
  glm::dvec3 target(0, 1.5, -4);
  const auto linesOf = [&](LightKind kind, tests::Layout layout,
                           const std::function<void(reference::ShadowImage&)>& drawn,
                           const std::function<void(Light&)>& told) {
    const auto rig = tests::layoutRig(kind, false, 96);
    frameOf(*rig).settings.technique = Technique::Epipolar;
    rig->look(tests::lookAt({0, 2, 0}, target));
    reference::ShadowImage image = rig->scene.shadow(0);
    drawn(image);
    const tests::LaidMaps maps(image, layout, 1, GL_DEPTH_COMPONENT32F);
    maps.enter(lightOf(*rig));
    told(lightOf(*rig));
    const auto effect = checkingEffect();
    const Outcome outcome = render(*effect, frameOf(*rig));
    CHECK(outcome.status);
    return joined(outcome.warnings);
  };
  const auto asIs = [](auto& /*unused*/) {};
  const auto says = [](const std::string& lines, const std::string& words) {
    INFO(lines);
    CHECK(lines.find(words) != std::string::npos);
  };
  const auto ofTile = [](Light& light, const std::function<glm::dmat4(const Rectangle&, glm::dvec2)>& change) {
    glm::ivec2 size;
    gl().BindTexture(GL_TEXTURE_2D, light.shadow.texture);
    gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &size.x);
    gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &size.y);
    for (ShadowView& view : light.shadow.views)
      view.clipFromWorld = tests::toMat4(change(view.rectangle, size) * reference::toMat4(view.clipFromWorld));
  };
  using tests::Layout;
  CHECK(linesOf(kSun, Layout::Atlas, asIs, asIs).empty());
  CHECK(linesOf(kLamp, Layout::Cube, asIs, asIs).empty());
  says(linesOf(kSun, Layout::Atlas, asIs,
               [&](Light& light) {
                 ofTile(light, [](const Rectangle& r, const glm::dvec2& size) {
                   const glm::dvec3 scale(r.width / size.x, r.height / size.y, 1);
                   const glm::dvec3 middle((2 * r.x + r.width) / size.x - 1, (2 * r.y + r.height) / size.y - 1, 0);
                   return glm::scale(glm::translate(glm::dmat4(1), middle), scale);
                 });
               }),
       "clipFromWorld is a matrix into the whole layer");
  says(linesOf(kSun, Layout::Atlas, asIs,
               [](Light& light) {
                 GLint height = 0;
                 gl().BindTexture(GL_TEXTURE_2D, light.shadow.texture);
                 gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
                 for (ShadowView& view : light.shadow.views)
                   view.rectangle.y = height - view.rectangle.y - view.rectangle.height;
               }),
       "rectangle counts rows from the top");
  says(linesOf(kSun, Layout::Atlas, asIs,
               [](Light& light) {
                 Places& views = light.shadow.views;
                 std::swap(views[0].rectangle, views[1].rectangle);
                 std::swap(views[1].rectangle, views[2].rectangle);
               }),
       "views are in another order than their layers or rectangles");
  for (const std::size_t axis : {1, 2}) {
    CAPTURE(axis);
    says(linesOf(
             kLamp, Layout::Cube,
             [&](reference::ShadowImage& image) { // a face of the axis for the other
               const auto face = static_cast<std::ptrdiff_t>(image.depth.size() / 6);
               const auto first = image.depth.begin() + 2 * static_cast<std::ptrdiff_t>(axis) * face;
               std::swap_ranges(first, first + face, first + face);
             },
             asIs),
         "the cube's faces are in another order than GL's");
  }
  says(linesOf(
           kLamp, Layout::Cube,
           [](reference::ShadowImage& image) {
             const auto face = static_cast<std::ptrdiff_t>(image.depth.size() / 6);
             for (auto i = image.depth.begin(); i != image.depth.end(); i += face)
               std::reverse(i, i + face);
           },
           asIs),
       "the cube's faces are upside down");
  says(linesOf(kLamp, Layout::Cube, asIs, [](Light& light) { light.shadow.cube.nearDistance *= 5; }),
       "cube.nearDistance");
  says(linesOf(kLamp, Layout::Cube, asIs,
               [](Light& light) {
                 light.shadow.encoding = DepthEncoding::Radial;
                 light.shadow.scale.unit = 60;
               }),
       "encoding, scale");
  for (const float cleared : {0.0F, 1.0F}) {
    CAPTURE(cleared);
    const std::string lines = linesOf(
        kSun, Layout::Atlas,
        [&](reference::ShadowImage& image) { std::fill(image.depth.begin(), image.depth.end(), cleared); }, asIs);
    says(lines, cleared == 0 ? "of the map is at its near plane" : "where the map has none");
    CHECK(lines.find("sky in the scene depth") == std::string::npos);
  }
}

TEST_CASE("each of several cameras has the warnings of its own pictures") {
  tests::ShaftRig right = rightRig(kSun);
  Frame wrong = frameOf(right);
  wrong.camera.viewFromWorld = tests::lookAt({0, 2, 0}, {1, 2, -1});
  wrong.reuse.eye = 7;
  const auto effect = checkingEffect();
  for (int i = 0; i < 6; ++i) {
    CHECK(effect->render(frameOf(right)));
    CHECK(effect->statistics().warnings.empty());
    CHECK(effect->render(wrong));
    if (i > 3) CHECK_FALSE(effect->statistics().warnings.empty());
    gl().Finish();
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
