// Light of the surroundings (Frame::ambient): against integrals over the sphere, conservation, with lights, under
// reuse.
#include "AirlightSweep.h"
#include "MediaRig.h"
#include "ReuseRig.h"
#include "ShaftRig.h"
#include "gl/Gl.h"
#include "gl/ReadBack.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tyndall;
using namespace tests::media;
using tests::errorOf;

namespace {

Ambient even(float radiance) {
  Ambient ambient;
  ambient.radiance = {radiance, radiance, radiance};
  return ambient;
}

std::vector<Constituent> phases() {
  std::vector<Constituent> all = {{{}, Phase::Isotropic}, {{}, Phase::Rayleigh}};
  for (const float g : {-0.9F, 0.0F, 0.5F, 0.98F})
    for (const Phase phase : {Phase::HenyeyGreenstein, Phase::CornetteShanks})
      all.push_back({{}, phase, g});
  return all;
}

host::GlTexture occlusionTexture(tests::SceneRig& rig, int width, int height, const std::vector<float>& shares) {
  host::GlTexture texture = tests::floatTexture(GL_R32F, width, height, shares);
  rig.occlusion = {width, height, shares};
  rig.frame.ambient.occlusion.texture = texture.name();
  return texture;
}

} // namespace

TEST_CASE("ambient light equals the integral over the sphere and along the ray, for every phase", "[sweep]") {
  for (const Constituent& constituent : phases()) {
    CAPTURE(static_cast<int>(constituent.phase), constituent.g);
    CHECK(errorOf({{}, tests::mediumOf(constituent), sky()}) <= 1e-5);
    CHECK(errorOf({{}, tests::mediumOf(constituent), even(0.7F)}) <= 1e-5);
  }
}

TEST_CASE("ambient light through layers equals adaptive quadrature", "[sweep]") {
  const double height = tests::kSweepEye[1];
  const std::vector<HeightLayer> layers = {
      {height - 0.008, 1e-3}, {height + 0.25, 0.05}, {height, 1, height - 2}, {height - 240, 30}, {height, 1e9}};
  for (const HeightLayer& layer : layers) {
    CAPTURE(layer.height, layer.scale, layer.ground);
    Medium medium = tests::mediumOf({{}, Phase::HenyeyGreenstein, 0.6F, 0});
    medium.absorptionLayer = 0;
    medium.layers = {layer};
    CHECK(errorOf({{}, medium, sky()}) <= 1e-5);
    medium.constituents.push_back({{0.2F, 0.1F, 0.05F}, Phase::Rayleigh});
    CHECK(errorOf({{}, medium, sky()}) <= 1e-5);
    medium.layers.push_back({height, 20});
    medium.constituents[1].layer = 1;
    CHECK(errorOf({{}, medium, sky()}) <= 1e-5);
  }
}

// What is as bright as its surroundings is not seen in a medium that absorbs nothing.
TEST_CASE(
    "what is as bright as its surroundings vanishes in fog: light is conserved, for every phase, through layers") {
  for (const Constituent& constituent : phases())
    for (const bool fog : {false, true}) {
      tests::SceneRig rig;
      Medium medium = fog ? layered() : haze();
      for (Constituent& c : medium.constituents) {
        c.phase = constituent.phase;
        c.g = constituent.g;
      }
      rig.frame.medium = medium;
      rig.frame.ambient = even(0.8F);
      const reference::ImageAnswer got = rig.render();
      double worst = 0;
      for (std::size_t i = 0; i < got.inscatter.rgb.size(); ++i)
        worst = std::max(worst, std::abs(got.inscatter.rgb[i] + 0.8 * got.transmittance.rgb[i] - 0.8F));
      CAPTURE(static_cast<int>(constituent.phase), constituent.g, fog);
      CHECK(worst <= 2e-6);
    }
}

TEST_CASE("a picture of lights and surroundings is the sum of both, by every technique") {
  for (const Technique technique : kTechniques)
    for (const Medium& medium : {haze(), layered()}) {
      tests::SceneRig rig = tests::threeLights();
      rig.frame.medium = medium;
      rig.frame.settings.technique = technique;
      const reference::ImageAnswer lights = rig.render();
      rig.frame.ambient = sky();
      const reference::ImageAnswer all = rig.render();
      rig.frame.lights.clear();
      const reference::ImageAnswer surroundings = rig.render();
      rig.frame.ambient = {};
      CAPTURE(static_cast<int>(technique), medium.layers.size());
      CHECK(tests::difference(all.inscatter, sumOf(lights.inscatter, surroundings.inscatter)) <= 1e-6);
      CHECK(tests::difference(all.transmittance, lights.transmittance) <= 1e-6);
      for (const reference::Image& image : {surroundings.inscatter, lights.inscatter}) // neither is black
        CHECK(*std::max_element(image.rgb.begin(), image.rgb.end()) > 1e-3);
    }
}

TEST_CASE("exact with ambient light equals map-exact") {
  tests::SceneRig rig = tests::threeLights();
  rig.frame.settings.technique = Technique::Exact;
  rig.frame.ambient = sky();
  for (const Medium& medium : {haze(), layered()}) {
    rig.frame.medium = medium;
    const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
    CAPTURE(medium.layers.size());
    CHECK(reference::compare(got.inscatter, wanted.inscatter).rRmse <= 1e-3);
    CHECK(tests::difference(got.transmittance, wanted.transmittance) <= 1e-5);
  }
}

TEST_CASE("of a multisampled depth ambient light is the mean over a pixel's samples, with lights and without") {
  tests::SceneRig unlit, lit = tests::threeLights();
  for (tests::SceneRig* rig : {&unlit, &lit}) {
    const std::vector<float> depth = rig->depth();
    rig->setMultisampledDepth(4, GL_DEPTH_COMPONENT32F, [&](int pixel, int sample) {
      return depth[(static_cast<std::size_t>(pixel) + static_cast<std::size_t>(sample)) % depth.size()];
    });
    rig->frame.medium = layered();
  }
  unlit.frame.ambient = sky();
  const reference::ImageAnswer got = unlit.render(), wanted = unlit.reference();
  CHECK(tests::difference(got.inscatter, wanted.inscatter) <= 1e-5);
  CHECK(tests::difference(got.transmittance, wanted.transmittance) <= 1e-5);
  for (const Technique technique : kTechniques) {
    lit.frame.settings.technique = technique;
    const reference::ImageAnswer lights = lit.render();
    lit.frame.ambient = sky();
    const reference::ImageAnswer both = lit.render();
    lit.frame.ambient = {};
    CAPTURE(static_cast<int>(technique));
    CHECK(tests::difference(both.inscatter, sumOf(lights.inscatter, got.inscatter)) <= 1e-6);
    CHECK(tests::difference(both.transmittance, lights.transmittance) <= 1e-6);
  }
}

TEST_CASE("colour receives what the outputs hold, ambient light too, by dual-source blending and by a copy") {
  for (const Compositing compositing : {Compositing::DualSource, Compositing::Copy})
    for (const Technique technique : {Technique::Exact, Technique::Epipolar})
      for (const bool lit : {false, true}) {
        tests::SceneRig rig;
        if (lit) rig.addLight(LightKind::Spot);
        rig.frame.medium = layered();
        rig.frame.ambient = sky();
        rig.frame.settings.technique = technique;
        const reference::ImageAnswer outputs = rig.render();
        const auto width = rig.frame.viewport.width, height = rig.frame.viewport.height;
        const std::vector<float> back(static_cast<std::size_t>(4 * width * height), 0.5F);
        const host::GlTexture colour = rig.makeColour(GL_RGBA32F, back);
        rig.frame.output = {};
        Config config;
        config.tuning.compositing = compositing;
        const std::unique_ptr<Effect> effect = tests::newEffect(config);
        REQUIRE(effect->render(rig.frame));
        const reference::Image got(width, height, host::readColour(colour.name(), width, height, 3));
        reference::Image wanted = outputs.inscatter;
        for (std::size_t i = 0; i < wanted.rgb.size(); ++i)
          wanted.rgb[i] += 0.5 * outputs.transmittance.rgb[i];
        CAPTURE(static_cast<int>(compositing), static_cast<int>(technique), lit);
        CHECK(tests::difference(got, wanted) <= 1e-6);
      }
}

TEST_CASE("an occlusion texture of any size hides the surroundings by its bilinear share, whatever it holds") {
  tests::SceneRig rig;
  rig.frame.medium = haze();
  rig.frame.ambient = sky();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [width, height] : {std::pair{24, 16}, std::pair{5, 3}, std::pair{61, 40}, std::pair{1, 1}}) {
    std::vector<float> shares;
    for (int i = 0; i < width * height; ++i)
      shares.push_back(i % 7 == 3 ? nan : 1.4F * static_cast<float>((i * 37) % 101) / 100 - 0.2F);
    const host::GlTexture texture = occlusionTexture(rig, width, height, shares);
    const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
    CAPTURE(width, height);
    CHECK(tests::difference(got.inscatter, wanted.inscatter) <= 1e-5);
    CHECK(tests::difference(got.transmittance, wanted.transmittance) <= 1e-6);
  }
}

TEST_CASE("an occlusion texture may have any format of one channel") {
  tests::SceneRig rig;
  rig.frame.medium = haze();
  rig.frame.ambient = sky();
  const std::vector<float> shares = {0, 0.25F, 0.5F, 1, 0.75F, 0.125F};
  rig.occlusion = {3, 2, shares};
  for (const auto& [format, rounding] : {std::pair{GL_R8, 1 / 255.0}, std::pair{GL_R16, 1 / 65535.0},
                                         std::pair{GL_R16F, 1e-3}, std::pair{GL_R32F, 1e-6}}) {
    const host::GlTexture texture = host::makeTexture2D(static_cast<GLenum>(format), 3, 2);
    host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 3, 2, GL_RED, GL_FLOAT, shares.data());
    rig.frame.ambient.occlusion.texture = texture.name();
    CAPTURE(format);
    CHECK(tests::difference(rig.render().inscatter, rig.reference().inscatter) <= 2 * rounding + 1e-5);
  }
}

TEST_CASE("harmonics that make what is scattered negative scatter nothing there, and a warning says so") {
  tests::SceneRig rig;
  rig.frame.ambient = even(0.1F);
  rig.frame.ambient.harmonics[1] = {1, 0, -1};
  for (const Medium& medium : {haze(), layered()}) {
    rig.frame.medium = medium;
    const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
    CHECK(tests::isFiniteAndNonNegative(got.inscatter));
    CHECK(tests::difference(got.inscatter, wanted.inscatter) <= 1e-5);
    if (medium.layers.empty()) // else what follows the layers scatters some
      CHECK(std::any_of(got.inscatter.rgb.begin(), got.inscatter.rgb.end(), [](double v) { return v == 0; }));
    const std::vector<std::string> warnings = tests::testEffect().statistics().warnings;
    CHECK(std::any_of(warnings.begin(), warnings.end(),
                      [](const std::string& warning) { return warning.find("Frame::ambient.harmonics") == 0; }));
  }
  rig.frame.ambient = sky();
  rig.render();
  CHECK(tests::testEffect().statistics().warnings.empty());
}

TEST_CASE("surroundings as bright as formats hold are capped, with lights and without") {
  tests::SceneRig rig;
  rig.frame.medium = haze();
  rig.frame.ambient = even(3e38F);
  rig.frame.ambient.harmonics[1] = {-1e38F, 3e38F, 0};
  for (const bool lit : {false, true}) {
    rig.frame.medium = lit ? layered() : haze();
    if (lit) rig.frame.medium.layers[0].scale = 1e-3;
    if (lit) rig.addLight(LightKind::Point);
    for (const Technique technique : kTechniques) {
      rig.frame.settings.technique = technique;
      tests::checkFinite(rig);
    }
    const auto pixels = static_cast<std::size_t>(rig.frame.viewport.width * rig.frame.viewport.height);
    const host::GlTexture colour = rig.makeColour(GL_RGBA16F, std::vector<float>(4 * pixels, 0.5F));
    const Output output = std::exchange(rig.frame.output, {});
    REQUIRE(tests::testEffect().render(rig.frame));
    for (const float value : host::readColour(colour.name(), rig.frame.viewport.width, rig.frame.viewport.height, 3))
      REQUIRE(std::isfinite(value));
    rig.frame.output = output;
    rig.frame.colour = 0;
  }
}

TEST_CASE("surroundings that add nothing are skipped, and the statistics say why") {
  tests::SceneRig rig;
  rig.frame.medium = haze();
  rig.render();
  CHECK(passNamed(tests::testEffect().statistics(), "ambient") == nullptr); // asked for by no one
  rig.frame.ambient = sky();
  rig.render();
  REQUIRE(passNamed(tests::testEffect().statistics(), "ambient"));
  CHECK(passNamed(tests::testEffect().statistics(), "ambient")->skipped.empty());
  CHECK(passNamed(tests::testEffect().statistics(), "transmittance") == nullptr); // which it brings itself
  rig.frame.medium.constituents.clear();
  rig.frame.medium.absorption = {0.1F, 0.1F, 0.1F};
  rig.render();
  CHECK(passNamed(tests::testEffect().statistics(), "ambient")->skipped == "the medium does not scatter");
  rig.frame.medium = haze();
  const std::uint32_t inscatter = std::exchange(rig.frame.output.inscatter, 0);
  REQUIRE(tests::testEffect().render(rig.frame));
  CHECK(passNamed(tests::testEffect().statistics(), "ambient")->skipped == "only the transmittance is wanted");
  rig.frame.output.inscatter = inscatter;
}

TEST_CASE("a change of the surroundings draws all pixels and no slice, and the picture is that of a frame in full") {
  tests::ShaftRig rig(64, 48);
  rig.addLight(tests::shaftLight(LightKind::Directional), 64);
  Frame& frame = rig.scene.frame;
  frame.settings.technique = Technique::Epipolar;
  frame.medium = haze();
  frame.ambient = sky();
  std::vector<float> shares(16, 0.5F);
  const host::GlTexture texture = occlusionTexture(rig.scene, 4, 4, shares);
  frame.depth.version = frame.ambient.occlusion.version = 1;
  for (Light& light : frame.lights)
    light.shadow.version = 1;
  const auto inFull = [&] {
    const Reuse reuse = std::exchange(frame.reuse, {});
    const reference::Image picture = rig.scene.render().inscatter;
    frame.reuse = reuse;
    return picture;
  };
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    const std::unique_ptr<Effect> effect = tests::newEffect();
    frame.reuse = {};
    frame.reuse.changes = changes;
    const auto next = [&](double redrawn) {
      ++frame.reuse.frame;
      const reference::Image picture = rig.scene.render(*effect).inscatter;
      CHECK(tests::difference(picture, inFull()) <= 1e-6);
      CHECK(effect->statistics().redrawnShare == redrawn);
    };
    CAPTURE(static_cast<int>(changes));
    next(1);
    next(0);
    CHECK(passNamed(effect->statistics(), "ambient") == nullptr);
    frame.ambient.radiance = {2, 1, 1};
    next(0);
    CHECK(passNamed(effect->statistics(), "ambient"));
    next(0);
    CHECK(passNamed(effect->statistics(), "ambient") == nullptr);
    std::fill(shares.begin(), shares.end(), shares[0] == 0.5F ? 0.9F : 0.5F);
    host::gl().BindTexture(GL_TEXTURE_2D, texture.name());
    host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 4, GL_RED, GL_FLOAT, shares.data());
    ++frame.ambient.occlusion.version;
    next(0);
    frame.ambient = {};
    next(0);
    frame.ambient = sky();
    frame.ambient.occlusion = {texture.name(), 0}; // of which nothing is known
    next(0);
    next(0);
    CHECK(passNamed(effect->statistics(), "ambient"));
    frame.ambient.occlusion.version = 1;
  }
}

TEST_CASE("where a part of a picture is drawn anew its ambient light is what it would be in full") {
  for (const Masking masking : {Masking::Stencil, Masking::Tiles})
    for (const Changes changes : {Changes::Detect, Changes::Objects}) {
      Config config;
      config.tuning.reuse = masking;
      const std::unique_ptr<Effect> effect = tests::newEffect(config);
      tests::ShaftRig rig = tests::reuse::sunlit(changes);
      rig.addLight(tests::reuse::spot(), 64);
      Frame& frame = rig.scene.frame;
      frame.medium = layered();
      frame.ambient = sky();
      for (int i = 0; i < 4; ++i) {
        tests::reuse::moveTo(rig, i);
        ++frame.depth.version;
        for (Light& light : frame.lights)
          ++light.shadow.version;
        const reference::ImageAnswer kept = rig.scene.render(*effect);
        const Statistics statistics = effect->statistics();
        CAPTURE(static_cast<int>(masking), static_cast<int>(changes), i);
        CHECK(passNamed(statistics, "ambient"));
        if (i > 0) CHECK((statistics.redrawnShare > 0 && statistics.redrawnShare < 1));
        const reference::ImageAnswer whole = tests::reuse::full(rig);
        CHECK(tests::difference(kept.inscatter, whole.inscatter) <= 1e-5);
        CHECK(tests::difference(kept.transmittance, whole.transmittance) <= 1e-6);
      }
    }
}

TEST_CASE("ambient light of a multisampled depth is kept under reuse, and is that of a frame in full") {
  tests::SceneRig rig;
  rig.addLight(LightKind::Directional);
  const std::vector<float> depth = rig.depth();
  rig.setMultisampledDepth(4, GL_DEPTH_COMPONENT32F, [&](int pixel, int sample) {
    return depth[(static_cast<std::size_t>(pixel) + static_cast<std::size_t>(sample)) % depth.size()];
  });
  rig.frame.medium = layered();
  rig.frame.ambient = sky();
  rig.frame.settings.technique = Technique::Epipolar;
  rig.frame.depth.version = rig.frame.lights[0].shadow.version = 1;
  const reference::ImageAnswer whole = rig.render();
  const std::unique_ptr<Effect> effect = tests::newEffect();
  rig.frame.reuse.changes = Changes::Detect;
  for (int i = 0; i < 3; ++i) {
    rig.frame.ambient.radiance[0] = i == 1 ? 3.0F : sky().radiance[0];
    const reference::ImageAnswer kept = rig.render(*effect);
    CAPTURE(i);
    if (i == 1) CHECK(reference::compare(kept.inscatter, whole.inscatter).rRmse > 0.01);
    if (i != 1) CHECK(tests::difference(kept.inscatter, whole.inscatter) <= 1e-6);
    CHECK(tests::difference(kept.transmittance, whole.transmittance) <= 1e-6);
  }
}
