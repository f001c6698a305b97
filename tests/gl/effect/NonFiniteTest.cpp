// NaN and Inf in what the engine hands in: everything keeps to its own pixel and the light stays finite.
#include "ReuseRig.h"
#include "gl/ReadBack.h"

#include <cmath>
#include <limits>

using namespace tyndall;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr int kX = 10, kY = 7; // the pixel that things happen to

// Everything of the pixel (kX, kY) put aside: the rest must be equal bit by bit.
void checkEqualElsewhere(const std::vector<double>& image, const std::vector<double>& expected, std::size_t channels) {
  REQUIRE(image.size() == expected.size());
  const std::size_t own = static_cast<std::size_t>(kY * 24 + kX);
  std::size_t different = 0;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (i / channels != own && image[i] != expected[i]) ++different;
  CHECK(different == 0);
}

// Writes a light's maps with every third texel and every fifth pane replaced; R32F holds anything.
tests::ShadowRig spoil(tests::ShaftRig& rig, std::size_t light, float depth, float pane) {
  tests::ShadowRig maps;
  maps.image = rig.scene.shadow(light);
  for (std::size_t i = 0; i < maps.image.depth.size(); ++i) {
    if (i % 3 == 0) maps.image.depth[i] = depth;
    if (i % 5 == 0 && !maps.image.glassDepth.empty()) maps.image.glassDepth[i] = pane;
  }
  maps.upload(rig.scene.frame.lights[light], true, GL_R32F);
  return maps;
}

} // namespace

TEST_CASE("odd depth values stay in their own pixel") {
  for (const bool reversed : {true, false}) {
    tests::SceneRig rig = tests::threeLights();
    tests::DepthConvention convention = rig.convention();
    convention.reversed = reversed;
    rig.setConvention(convention);
    const std::vector<float> back(4 * 24 * 16, 0.5F);
    const host::GlTexture colour = rig.makeColour(GL_RGBA32F, back);
    const auto readColour = [&] {
      const std::vector<float> values = host::readColour(colour.name(), 24, 16);
      return std::vector<double>(values.begin(), values.end());
    };
    const reference::ImageAnswer expected = rig.render();
    const std::vector<double> expectedColour = readColour();
    const std::vector<float> depth = rig.depth();
    for (const float odd : {kNan, kInf, -kInf, -1.0F, 2.0F, 1e30F, 1e-40F}) {
      CAPTURE(reversed, odd);
      std::vector<float> broken = depth;
      broken[kY * 24 + kX] = odd;
      rig.setDepth(broken);
      const host::GlTexture target = rig.makeColour(GL_RGBA32F, back);
      const reference::ImageAnswer answer = rig.render();
      const std::vector<float> composite = host::readColour(target.name(), 24, 16);
      checkEqualElsewhere(answer.inscatter.rgb, expected.inscatter.rgb, 3);
      checkEqualElsewhere(answer.transmittance.rgb, expected.transmittance.rgb, 3);
      checkEqualElsewhere({composite.begin(), composite.end()}, expectedColour, 4);
      CHECK(tests::isFiniteAndNonNegative(answer.inscatter));
      CHECK(tests::isFiniteAndNonNegative(answer.transmittance));
      if (std::isnan(odd)) { // left as it is
        CHECK(answer.inscatter.at(kX, kY) == glm::dvec3(0));
        CHECK(answer.transmittance.at(kX, kY) == glm::dvec3(1));
        for (std::size_t c = 0; c < 4; ++c)
          CHECK(composite[4 * (kY * 24 + kX) + c] == 0.5F);
      }
    }
  }
}

TEST_CASE("NaN and Inf in the colour stay in their own pixel") {
  tests::SceneRig rig = tests::threeLights();
  for (const bool outputs : {false, true})
    for (const float odd : {kNan, kInf, -kInf}) {
      CAPTURE(outputs, odd);
      std::vector<std::vector<double>> pictures;
      for (const bool broken : {false, true}) {
        std::vector<float> back(4 * 24 * 16, 0.5F);
        if (broken) back[4 * (kY * 24 + kX) + 1] = odd;
        const host::GlTexture colour = rig.makeColour(GL_RGBA16F, back);
        Frame frame = rig.frame;
        if (!outputs) frame.output = {};
        REQUIRE(tests::testEffect().render(frame));
        const std::vector<float> values = host::readColour(colour.name(), 24, 16);
        pictures.emplace_back(values.begin(), values.end());
      }
      checkEqualElsewhere(pictures[1], pictures[0], 4);
    }
}

TEST_CASE("NaN and Inf in a shadow or glass map stay finite in the picture") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const float odd : {kNan, kInf, -kInf, -3.0F, 1e30F}) {
        CAPTURE(static_cast<int>(kind), static_cast<int>(filter), odd);
        tests::SceneRig rig;
        Light& light = rig.addLight(kind, tests::Casters::Blocks, true);
        rig.frame.settings.shadowFilter = filter;
        reference::ShadowImage image = rig.shadow(0);
        for (std::size_t i = 0; i < image.depth.size(); ++i) {
          if (i % 3 == 0) image.depth[i] = odd;
          if (i % 5 == 0) image.glassDepth[i] = odd;
          if (i % 7 == 0) image.glassColour[3 * i + i % 3] = odd;
        }
        tests::ShadowRig maps; // R32F holds anything
        maps.image = image;
        maps.upload(light, true, GL_R32F);
        tests::checkFinite(rig);
      }
}

TEST_CASE("a shadow texel or pane that is not a number is none, by every technique", "[sweep][slow]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const bool glass : {false, true}) {
        tests::ShaftRig rig(48, 32);
        rig.addLight(tests::shaftLight(kind), 64, glass);
        rig.scene.frame.settings.shadowFilter = filter;
        for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
          CAPTURE(static_cast<int>(kind), static_cast<int>(filter), glass, static_cast<int>(technique));
          rig.scene.setShadow(0, reference::ShadowImage(rig.scene.shadow(0)));
          const reference::Image whole = rig.picture(technique);
          const tests::ShadowRig none = spoil(rig, 0, 1, kInf);
          const reference::Image expected = rig.picture(technique);
          const tests::ShadowRig odd = spoil(rig, 0, kNan, kNan);
          CHECK(rig.picture(technique) == expected);
          CHECK(tests::difference(expected, whole) > 0.01);
        }
      }
}

TEST_CASE("exact equals map-exact with texels and panes that are infinite or not numbers", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot})
    for (const float odd : {kNan, kInf, -kInf}) {
      CAPTURE(static_cast<int>(kind), odd);
      tests::SceneRig rig;
      rig.addLight(kind, tests::Casters::Blocks, true);
      rig.frame.settings.technique = Technique::Exact;
      reference::ShadowImage image = rig.shadow(0);
      for (std::size_t i = 0; i < image.depth.size(); ++i) {
        if (i % 3 == 0) image.depth[i] = odd;
        if (i % 5 == 0) image.glassDepth[i] = odd;
        if (i % 7 == 0) image.glassColour[3 * i + i % 3] = odd;
      }
      rig.setShadow(0, image);
      tests::ShadowRig maps;
      maps.image = image;
      maps.upload(rig.frame.lights[0], true, GL_R32F);
      CHECK(tests::difference(rig.render().inscatter, rig.reference().inscatter) <= 1e-4);
    }
}

TEST_CASE("texels that are not numbers do not count as a change", "[sweep]") {
  for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
    CAPTURE(static_cast<int>(filter));
    tests::ShaftRig rig(48, 32);
    rig.addLight(tests::shaftLight(LightKind::Directional), 64);
    rig.scene.frame.settings.shadowFilter = filter;
    const tests::ShadowRig odd = spoil(rig, 0, kNan, kNan);
    tests::reuse::begin(rig, Changes::Detect);
    CHECK(tests::reuse::reused(rig).share == 1);
    CHECK(tests::reuse::reused(rig).share == 0);
  }
}

TEST_CASE("depth that is odd for a frame leaves nothing in the frames after it", "[sweep]") {
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const float odd : {kNan, kInf, -1.0F}) {
      CAPTURE(static_cast<int>(changes), odd);
      tests::ShaftRig rig(48, 32);
      rig.addLight(tests::shaftLight(LightKind::Directional), 64);
      rig.addLight(tests::reuse::spot(), 64);
      tests::reuse::begin(rig, changes);
      Frame& frame = rig.scene.frame;
      const std::vector<float> clean = rig.scene.depth();
      std::vector<float> spoilt = clean;
      for (std::size_t y = 10; y < 18; ++y)
        for (std::size_t x = 20; x < 26; ++x)
          spoilt[y * 48 + x] = odd;
      const glm::dmat4 everywhere = glm::scale(glm::dmat4(1), glm::dvec3(60)); // of what has changed
      for (const bool isSpoilt : {false, true, false, true, true, false}) {
        rig.scene.setDepth(isSpoilt ? spoilt : clean);
        ++frame.reuse.frame;
        frame.objects.clear();
        if (changes == Changes::Objects && frame.reuse.frame > 1)
          frame.objects = {tests::reuse::between(everywhere, everywhere)};
        const tests::reuse::Picture picture = tests::reuse::reused(rig);
        tests::reuse::checkSame(picture, tests::reuse::full(rig));
        CHECK(tests::isFiniteAndNonNegative(picture.answer.inscatter));
        CHECK(tests::isFiniteAndNonNegative(picture.answer.transmittance));
      }
      ++frame.reuse.frame;
      frame.objects.clear();
      CHECK(tests::reuse::reused(rig).share == 0);
    }
}

// One that lies before the near plane shades all behind it, one beyond the far plane nothing in front of that.
TEST_CASE("shadow texels outside of 0 to 1 are the ends of that range, by every technique", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      tests::ShaftRig rig(48, 32);
      rig.addLight(tests::shaftLight(kind), 64);
      rig.scene.frame.settings.shadowFilter = filter;
      for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
        for (const float odd : {1.5F, 1e30F, kInf, -0.5F, -1e30F, -kInf}) {
          CAPTURE(static_cast<int>(kind), static_cast<int>(filter), static_cast<int>(technique), odd);
          const tests::ShadowRig end = spoil(rig, 0, odd > 0 ? 1.0F : 0.0F, 0);
          const reference::Image expected = rig.picture(technique);
          const tests::ShadowRig beyond = spoil(rig, 0, odd, 0);
          CHECK(tests::difference(rig.picture(technique), expected) <= 1e-6);
        }
    }
}
