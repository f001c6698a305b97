// Radiance of any unit: lux, candela, watts. Inscatter scales with the light; a format's largest value is the only
// ceiling.
#include "ShaftRig.h"
#include "gl/ReadBack.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace tyndall;

namespace {

const Medium kGrey = {{{{0.05F, 0.05F, 0.05F}, Phase::HenyeyGreenstein, 0.6F}}, {0.01F, 0.01F, 0.01F}};
const Medium kColoured = {
    {{{0.02F, 0.05F, 0.09F}, Phase::Rayleigh, 0}, {{0.03F, 0.03F, 0.02F}, Phase::CornetteShanks, 0.7F}},
    {0, 0.02F, 0.01F}};
// Extinction is grey, what the two constituents scatter is not.
const Medium kTinted = {
    {{{0.02F, 0.04F, 0.06F}, Phase::Rayleigh, 0}, {{0.06F, 0.04F, 0.02F}, Phase::HenyeyGreenstein, 0.7F}}, {}};

reference::Image pictureAt(tests::ShaftRig& rig, const Rgb& colour, float k) {
  for (std::size_t c = 0; c < 3; ++c)
    rig.scene.frame.lights[0].colour[c] = k * colour[c];
  reference::Image image = rig.scene.render().inscatter;
  for (double& value : image.rgb)
    value /= k;
  return image;
}

// The inscatter of 16 lights of one colour, of which all but one add next to nothing, in a half-float colour, beside
// that of the one alone.
struct Ceiling {
  tests::SceneRig rig;
  explicit Ceiling(const Rgb& others, tests::Casters casters) {
    rig.addLight(LightKind::Directional, tests::Casters::None).colour = {2.5e8F, 2.5e8F, 2.5e8F};
    for (int i = 1; i < kMaxLights; ++i)
      rig.addLight(LightKind::Directional, casters).colour = others;
    rig.frame.medium = {{{{1e-3F, 1e-3F, 1e-3F}, Phase::Isotropic, 0}}, {}};
  }
  std::vector<float> render(std::size_t lights, const Output& output) {
    const auto pixels =
        static_cast<std::size_t>(rig.frame.viewport.width) * static_cast<std::size_t>(rig.frame.viewport.height);
    const host::GlTexture colour = rig.makeColour(GL_RGBA16F, std::vector<float>(4 * pixels, 1));
    Frame frame = rig.frame;
    frame.lights.resize(lights);
    frame.output = output;
    const Status status = tests::testEffect().render(frame);
    INFO(status.message);
    REQUIRE(status);
    std::vector<float> values = host::readColour(colour.name(), frame.viewport.width, frame.viewport.height, 3);
    if (output.inscatter) {
      const std::vector<float> written =
          host::readColour(output.inscatter, frame.viewport.width, frame.viewport.height, 3);
      values.insert(values.end(), written.begin(), written.end());
    }
    return values;
  }
};

} // namespace

TEST_CASE("inscatter scales with the light from 1e-8 to 1e7, whatever medium, glass and technique", "[sweep]") {
  const Rgb colour = {1, 0.7F, 0};
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const Medium& medium : {kGrey, kColoured, kTinted})
      for (const bool glass : {false, true}) {
        tests::ShaftRig rig(48, 32);
        rig.scene.frame.medium = medium;
        rig.addLight(tests::shaftLight(kind), 64, glass);
        for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
          rig.scene.frame.settings.technique = technique;
          const reference::Image one = pictureAt(rig, colour, 1);
          for (const float k : {1e-8F, 1e-5F, 1e4F, 1e7F}) {
            const reference::ErrorMetrics error = reference::compare(pictureAt(rig, colour, k), one);
            CAPTURE(static_cast<int>(kind), glass, static_cast<int>(technique), k, error.text());
            CHECK(error.mean > 0);
            CHECK(error.rRmse <= 1e-5);
          }
        }
      }
}

TEST_CASE("epipolar serves the same samples whatever the light's unit") {
  tests::ShaftRig rig(48, 32);
  rig.scene.frame.medium = kColoured;
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  rig.scene.frame.settings.technique = Technique::Epipolar;
  for (const float spread : {std::numeric_limits<float>::infinity(), 0.02F}) {
    rig.scene.frame.settings.spreadThreshold = spread;
    pictureAt(rig, {1, 0.7F, 0}, 1);
    const Statistics one = tests::testEffect().statistics();
    for (const float k : {1e-8F, 1e7F}) {
      pictureAt(rig, {1, 0.7F, 0}, k);
      CAPTURE(spread, k);
      CHECK(tests::testEffect().statistics().marchedSamples == one.marchedSamples);
      CHECK(tests::testEffect().statistics().fixupPixels == one.fixupPixels);
    }
  }
}

TEST_CASE("a format's ceiling does not depend on lights that add nothing") {
  const Rgb black = {0, 0, 0}, faint = {1e-6F, 1e-6F, 1e-6F}, bright = {2.5e8F, 2.5e8F, 2.5e8F};
  for (const auto& [others, casters] : {std::pair{black, tests::Casters::None}, std::pair{faint, tests::Casters::None},
                                        std::pair{bright, tests::Casters::AllDark}}) {
    Ceiling ceiling(others, casters);
    for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
      ceiling.rig.frame.settings.technique = technique;
      const host::GlTexture half =
          tests::floatTexture(GL_RGBA16F, ceiling.rig.frame.viewport.width, ceiling.rig.frame.viewport.height,
                              std::vector<float>(4 * 24 * 16, 0));
      for (const Output& output : {Output{}, Output{half.name(), 0}}) {
        const std::vector<float> alone = ceiling.render(1, output), all = ceiling.render(kMaxLights, output);
        CAPTURE(others[0], static_cast<int>(casters), static_cast<int>(technique), output.inscatter);
        CHECK(*std::max_element(alone.begin(), alone.end()) > 10000);
        double worst = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
          worst = std::max(worst, std::abs(static_cast<double>(all[i]) - static_cast<double>(alone[i])) / alone[i]);
        CHECK(worst <= 1.0 / 1024); // a step of half floats
      }
    }
  }
}

TEST_CASE("an output of 32 bits is not cut to what a colour of 16 bits holds") {
  tests::SceneRig rig;
  rig.addLight(LightKind::Directional, tests::Casters::None).colour = {1e9F, 1e9F, 1e9F};
  rig.frame.medium = {{{{1e-3F, 1e-3F, 1e-3F}, Phase::Isotropic, 0}}, {}};
  const reference::Image alone = rig.render().inscatter;
  CHECK(*std::max_element(alone.rgb.begin(), alone.rgb.end()) > 65504);
  const host::GlTexture colour = rig.makeColour(GL_RGBA16F, std::vector<float>(4 * 24 * 16, 1));
  CHECK(rig.render().inscatter == alone);
  for (const float value : host::readColour(colour.name(), 24, 16, 3))
    CHECK(std::isfinite(value));
}
