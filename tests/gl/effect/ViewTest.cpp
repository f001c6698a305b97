// Debug views: known answers of each, on every kind of light.
#include "ShaftRig.h"

#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

using namespace tyndall;

namespace {

constexpr LightKind kKinds[] = {LightKind::Directional, LightKind::Point, LightKind::Spot};
constexpr float kAlpha = 0.5F;

bool allows(Technique technique, DebugView view) {
  if (view < DebugView::Slices || view > DebugView::NodeVisits) return true;
  if (technique == Technique::Tree) return view == DebugView::Slices || view == DebugView::NodeVisits;
  return technique == Technique::Epipolar;
}

struct Picture {
  int width = 0;
  std::vector<float> rgba; ///< row 0 at the bottom

  std::size_t pixels() const { return rgba.size() / 4; }
  glm::vec3 at(std::size_t pixel) const { return {rgba[4 * pixel], rgba[4 * pixel + 1], rgba[4 * pixel + 2]}; }
  glm::vec3 at(int x, int y) const { return at(static_cast<std::size_t>(y * width + x)); }
  glm::dvec3 sum() const {
    glm::dvec3 all(0);
    for (std::size_t i = 0; i < pixels(); ++i)
      all += glm::dvec3(at(i));
    return all;
  }
};

// Renders a view over a colour that it must replace, and whose alpha must stay.
Picture pictureOf(tests::SceneRig& scene, DebugView view, Effect& effect = tests::testEffect()) {
  const auto pixels =
      static_cast<std::size_t>(scene.frame.viewport.width) * static_cast<std::size_t>(scene.frame.viewport.height);
  const host::GlTexture colour = scene.makeColour(GL_RGBA32F, std::vector<float>(4 * pixels, kAlpha));
  scene.frame.settings.debugView = view;
  const Status status = effect.render(scene.frame);
  INFO(status.message);
  REQUIRE(status);
  Picture picture{scene.frame.viewport.width,
                  host::readColour(colour.name(), scene.frame.viewport.width, scene.frame.viewport.height)};
  for (std::size_t i = 0; i < pixels; ++i)
    REQUIRE(picture.rgba[4 * i + 3] == kAlpha);
  scene.frame.colour = 0;
  scene.frame.settings.debugView = DebugView::Composite;
  return picture;
}

bool isBlack(const Picture& picture) { return picture.sum() == glm::dvec3(0); }

// glsl/lib/scale.glsl
glm::vec3 signedColour(double t) {
  const glm::vec3 end = t < 0 ? glm::vec3(0, 0.1, 1) : glm::vec3(1, 0.1, 0);
  return glm::mix(glm::vec3(0.5F), end, static_cast<float>(std::min(std::abs(t), 1.0)));
}

// glsl/lib/scale.glsl
glm::vec3 heat(double t) {
  const std::array<glm::vec3, 5> stops = {glm::vec3(0), {0.1, 0.1, 0.8}, {0.8, 0.05, 0.1}, {1, 0.8, 0}, glm::vec3(1)};
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(4 * t), 3);
  return glm::mix(stops[low], stops[low + 1], static_cast<float>(4 * t - static_cast<double>(low)));
}

// The number whose colour is nearest.
int visitsOf(const glm::vec3& colour) {
  int best = 0;
  for (int visits = 1; visits < 1024; ++visits)
    if (glm::distance(heat(std::log2(1.0 + visits) / 10), colour) <
        glm::distance(heat(std::log2(1.0 + best) / 10), colour))
      best = visits;
  return best;
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

TEST_CASE("every view draws for every technique and light, and leaves the outputs as they were") {
  for (const LightKind kind : kKinds)
    for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
      tests::SceneRig scene;
      scene.addLight(kind, tests::Casters::Blocks, kind == LightKind::Spot);
      scene.frame.settings.technique = technique;
      scene.frame.settings.samples = 64;
      const reference::ImageAnswer expected = scene.render();
      for (int i = 1; i <= static_cast<int>(DebugView::Inputs); ++i) {
        const auto view = static_cast<DebugView>(i);
        CAPTURE(static_cast<int>(kind), static_cast<int>(technique), i);
        if (!allows(technique, view)) continue;
        const Picture picture = pictureOf(scene, view);
        for (std::size_t pixel = 0; pixel < picture.pixels(); ++pixel)
          REQUIRE((std::isfinite(picture.at(pixel).x) && picture.at(pixel).x >= 0));
        const reference::ImageAnswer outputs = scene.outputs();
        CHECK(outputs.inscatter == expected.inscatter);
        CHECK(outputs.transmittance == expected.transmittance);
        const Output asked = scene.frame.output;
        scene.frame.output = {};
        CHECK(pictureOf(scene, view).rgba == picture.rgba);
        scene.frame.output = asked;
      }
    }
}

TEST_CASE("the views of inscatter and transmittance are the outputs") {
  tests::SceneRig scene = tests::threeLights();
  for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
    scene.frame.settings.technique = technique;
    const Picture inscatter = pictureOf(scene, DebugView::Inscatter);
    const Picture transmittance = pictureOf(scene, DebugView::Transmittance);
    const reference::ImageAnswer outputs = scene.outputs();
    for (std::size_t i = 0; i < inscatter.pixels(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        REQUIRE(inscatter.rgba[4 * i + c] == static_cast<float>(outputs.inscatter.rgb[3 * i + c]));
        REQUIRE(transmittance.rgba[4 * i + c] == static_cast<float>(outputs.transmittance.rgb[3 * i + c]));
      }
  }
}

TEST_CASE("the fix-up view marks as many pixels as the statistics count") {
  for (const LightKind kind : kKinds) {
    tests::ShaftRig rig;
    rig.addLight(tests::shaftLight(kind));
    rig.scene.frame.settings.technique = Technique::Epipolar;
    rig.scene.frame.settings.leastWeight = 0.95F;
    const Picture picture = pictureOf(rig.scene, DebugView::FixupPixels);
    std::uint64_t marked = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
      const bool isRed = picture.at(i) == glm::vec3(1, 0, 0);
      REQUIRE((isRed || picture.at(i) == glm::vec3(0)));
      marked += isRed ? 1 : 0;
    }
    CAPTURE(static_cast<int>(kind));
    CHECK(marked > 0);
    CHECK(10 * marked < picture.pixels());
    CHECK(marked == tests::testEffect().statistics().fixupPixels);
  }
}

TEST_CASE("the views of samples and march samples count every one of them") {
  for (const LightKind kind : kKinds) {
    tests::ShaftRig rig;
    rig.addLight(tests::shaftLight(kind));
    rig.scene.frame.settings.technique = Technique::Epipolar;
    const glm::dvec3 samples = pictureOf(rig.scene, DebugView::Samples).sum();
    const glm::dvec3 march = pictureOf(rig.scene, DebugView::MarchSamples).sum();
    const Statistics statistics = tests::testEffect().statistics();
    CAPTURE(static_cast<int>(kind), march.x, march.y, march.z);
    CHECK(samples.x > rig.scene.frame.viewport.width);
    CHECK(samples.y == samples.x / 4);
    CHECK(samples.z == samples.x / 16);
    // One in sixteen of each slice, rounded up, is regular; the statistics count the packs of up to two others.
    CHECK(march.z >= samples.x / 16);
    CHECK(march.z <= samples.x / 16 + rig.scene.frame.settings.slices);
    const double packs = static_cast<double>(statistics.marchedSamples - statistics.fixupPixels) - march.z;
    CHECK(packs > 0);
    CHECK(march.x + march.y >= packs);
    CHECK(march.x + march.y <= 2 * packs);
  }
}

TEST_CASE("the view of breaks shows both sides of a step, near red and far blue") {
  constexpr int kWidth = 64, kHeight = 48, kEdge = 40;
  tests::SceneRig scene(kWidth, kHeight);
  scene.addLight(LightKind::Directional, tests::Casters::None);
  scene.frame.settings.technique = Technique::Epipolar;
  scene.frame.settings.samples = 128;
  for (std::size_t i = 0; i < scene.distances.size(); ++i)
    scene.distances[i] = static_cast<int>(i) % kWidth < kEdge ? 4 : 12;
  scene.setConvention({});
  const Picture step = pictureOf(scene, DebugView::Breaks);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      CAPTURE(x, y);
      if (step.at(x, y).r > 0) REQUIRE((x < kEdge && x >= kEdge - 2));
      if (step.at(x, y).b > 0) REQUIRE((x >= kEdge && x < kEdge + 2));
    }
  CHECK(step.sum().r > 8);
  CHECK(step.sum().b == step.sum().r);
  CHECK(step.sum().g == 0);
  scene.distances.assign(scene.distances.size(), 4);
  scene.setConvention({});
  CHECK(isBlack(pictureOf(scene, DebugView::Breaks)));
}

TEST_CASE("the view of visits shows where the tree is walked, with its scale") {
  const auto visits = [](tests::Casters casters, Technique technique) {
    tests::SceneRig scene;
    scene.addLight(LightKind::Directional, casters);
    scene.frame.settings.technique = technique;
    return pictureOf(scene, DebugView::NodeVisits);
  };
  const Picture blocks = visits(tests::Casters::Blocks, Technique::Tree);
  CHECK(blocks.rgba == visits(tests::Casters::Blocks, Technique::Epipolar).rgba); // of every pixel's ray
  const glm::dvec3 lit = visits(tests::Casters::AllLit, Technique::Tree).sum();
  CHECK(lit.b > 0);
  CHECK(blocks.sum().r > lit.r);
  CHECK(isBlack(visits(tests::Casters::None, Technique::Tree))); // no shadow map, no tree

  tests::ShaftRig rig; // 96 x 64: large enough for the bar
  rig.addLight(tests::shaftLight(LightKind::Directional));
  rig.scene.frame.settings.technique = Technique::Tree;
  const Picture large = pictureOf(rig.scene, DebugView::NodeVisits);
  CHECK(large.at(48, 4).r > 0.5F); // half-way: 31 visits, red
  CHECK(large.at(86, 4).g > 0.9F); // its end: white
  CHECK(large.at(86, 4).b > 0.7F);
  CHECK(large.at(10, 4).b < 0.2F); // its begin: black
}

TEST_CASE("the view of visits is counted: their mean a ray, which the tree makes smaller", "[sweep]") {
  for (const LightKind kind : kKinds)
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      CAPTURE(static_cast<int>(kind), static_cast<int>(technique));
      tests::ShaftRig rig;
      rig.addLight(tests::shaftLight(kind));
      Settings& settings = rig.scene.frame.settings;
      settings.technique = technique;
      const auto visits = [&](DebugView view) {
        pictureOf(rig.scene, view);
        return tests::testEffect().statistics().visitsPerRay;
      };
      const double withTree = visits(DebugView::NodeVisits);
      CHECK(withTree > 0);
      CHECK(visits(DebugView::Slices) == 0);
      CHECK(visits(DebugView::Difference) == 0);
      settings.minMaxTree = false;
      CHECK(visits(DebugView::NodeVisits) > withTree);
    }
}

TEST_CASE("the mean of visits is that of the picture") {
  tests::SceneRig scene; // too small for the scale bar
  scene.addLight(LightKind::Directional, tests::Casters::Blocks);
  scene.frame.settings.technique = Technique::Tree;
  const Picture picture = pictureOf(scene, DebugView::NodeVisits);
  const double mean = tests::testEffect().statistics().visitsPerRay;
  double sum = 0;
  for (std::size_t i = 0; i < picture.pixels(); ++i)
    sum += visitsOf(picture.at(i));
  CHECK(mean == Approx(sum / static_cast<double>(picture.pixels())));
}

TEST_CASE("the view of the difference is grey where nothing differs, else in its documented scale") {
  tests::SceneRig scene = tests::threeLights();
  scene.frame.settings.technique = Technique::Exact;
  const std::vector<double> exact = scene.render().inscatter.rgb;
  const Picture neutral = pictureOf(scene, DebugView::Difference);
  for (std::size_t i = 0; i < neutral.pixels(); ++i)
    REQUIRE(neutral.at(i) == glm::vec3(0.5F));
  scene.frame.settings.technique = Technique::Epipolar;
  const Picture picture = pictureOf(scene, DebugView::Difference);
  const std::vector<double> fast = scene.outputs().inscatter.rgb;
  double largest = 0;
  for (std::size_t i = 0; i < picture.pixels(); ++i) {
    double off = 0;
    for (std::size_t c = 0; c < 3; ++c)
      off += (fast[3 * i + c] - exact[3 * i + c]) / 3;
    const double t = off / (0.1 * meanOf(exact));
    largest = std::max(largest, std::abs(t));
    CAPTURE(i, t);
    REQUIRE(glm::distance(picture.at(i), signedColour(t)) < 2e-3F);
  }
  CHECK(largest > 0.01);
}

TEST_CASE("a view of slices shows the first light that is drawn, and black where none is") {
  tests::SceneRig scene;
  scene.addLight(LightKind::Point);
  scene.frame.settings.technique = Technique::Epipolar;
  const Light point = scene.frame.lights[0];
  Light sun = point;
  sun.kind = LightKind::Directional;
  sun.shadow = {};
  Light black = sun;
  black.colour = {0, 0, 0};
  for (const DebugView view : {DebugView::Slices, DebugView::Samples, DebugView::NodeVisits}) {
    scene.frame.lights = {point};
    const Picture alone = pictureOf(scene, view);
    CHECK_FALSE(isBlack(alone));
    scene.frame.lights = {black, point, sun};
    CHECK(pictureOf(scene, view).rgba == alone.rgba);
    scene.frame.lights = {black};
    CHECK(isBlack(pictureOf(scene, view)));
    scene.frame.lights = {point};
    const Medium medium = scene.frame.medium;
    scene.frame.medium = {};
    CHECK(isBlack(pictureOf(scene, view)));
    scene.frame.medium = medium;
  }
}

TEST_CASE("slices of one hue come in sixteens, every second one darker") {
  tests::ShaftRig rig;
  rig.addLight(tests::shaftLight(LightKind::Directional));
  rig.scene.frame.settings.technique = Technique::Tree;
  rig.scene.frame.settings.slices = 2;
  const Picture picture = pictureOf(rig.scene, DebugView::Slices);
  std::size_t bright = 0, dark = 0;
  for (std::size_t i = 0; i < picture.pixels(); ++i) {
    bright += picture.at(i) == glm::vec3(1.0F, 0.2F, 0.2F) ? 1 : 0;
    dark += picture.at(i) == glm::vec3(0.6F) * glm::vec3(1.0F, 0.2F, 0.2F) ? 1 : 0;
  }
  CHECK(bright > 0);
  CHECK(dark > 0);
  CHECK(bright + dark + 32 > picture.pixels()); // all but the epipole
}
