// Frame::lookup: light and transmittance up to a set of distances against exact that is cut there, what shaders make of
// it (shaftsLookupSource), and when it is left alone.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "MediaRig.h"
#include "RefusalRig.h"
#include "ReuseRig.h"
#include "ShaftRig.h"
#include "gl/ReadBack.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"
#include "support/ShaftsLookup.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace tyndall;
using namespace tests::media;

namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kFar = 40;
constexpr tests::ShaftsLookup::Range kRange{0.5, kFar};

// The frame as if a surface stood at a distance from the eye in each pixel.
reference::ImageAnswer cutAt(tests::SceneRig& rig, double distance, Technique technique = Technique::Exact) {
  const Frame frame = rig.frame;
  const auto pixels = static_cast<std::size_t>(frame.viewport.width * frame.viewport.height);
  const host::GlTexture depth = tests::floatTexture(GL_R32F, frame.viewport.width, frame.viewport.height,
                                                    std::vector<float>(pixels, static_cast<float>(distance)));
  rig.frame.depth = {};
  rig.frame.depth.texture = depth.name();
  const bool isOrthographic = frame.camera.clipFromView[15] != 0;
  rig.frame.depth.encoding = isOrthographic ? DepthEncoding::Axial : DepthEncoding::Radial;
  rig.frame.settings.technique = technique;
  rig.frame.lookup = {};
  const reference::ImageAnswer answer = rig.render();
  rig.frame = frame;
  return answer;
}

// Of a layer against exact that is cut there: no farther off than the tree's own picture, whose slices are up to half a
// pixel and rows half a texel from a pixel's ray, by more than `more`.
void checkAsTree(tests::SceneRig& rig, const tests::ShaftsLookup& layers, int layer, double more, double slack) {
  const reference::Image truth = cutAt(rig, layers.distance(layer)).inscatter;
  const double tree = reference::compare(cutAt(rig, layers.distance(layer), Technique::Tree).inscatter, truth).rRmse;
  CAPTURE(layer, tree);
  CHECK(meanOf(truth) > 0);
  CHECK(tree < 0.2);
  CHECK(reference::compare(layers.light(layer), truth).rRmse <= more * tree + slack);
}

} // namespace

TEST_CASE("layers of a look-up are exact's picture cut at their distances: every light, filter, glass, technique",
          "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const bool glass : {false, true}) {
        if (glass && filter == ShadowFilter::Bilinear) continue;
        tests::ShaftRig rig(kWidth, kHeight);
        rig.addLight(tests::shaftLight(kind), 128, glass);
        Frame& frame = rig.scene.frame;
        frame.settings.shadowFilter = filter;
        frame.medium = glass ? layered() : haze();
        tests::ShaftsLookup layers(kWidth, kHeight, 12, kRange);
        for (const int layer : {6, 10}) {
          const reference::Image truth = cutAt(rig.scene, layers.distance(layer)).inscatter;
          // As the tree has it, whose slices are up to half a pixel, and rows half a texel, from a pixel's ray.
          const double tree =
              reference::compare(cutAt(rig.scene, layers.distance(layer), Technique::Tree).inscatter, truth).rRmse;
          for (const Technique technique : {Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
            frame.settings.technique = technique;
            layers.enter(frame);
            rig.scene.render();
            CAPTURE(static_cast<int>(kind), static_cast<int>(filter), glass, layer, static_cast<int>(technique), tree);
            CHECK(meanOf(truth) > 0);
            CHECK(tree < 0.2);
            CHECK(reference::compare(layers.light(layer), truth).rRmse <= 1.1 * tree + 1e-3);
          }
        }
      }
}

TEST_CASE(
    "a look-up's transmittance, light without maps and ambient light are exact's to rounding, through layers too") {
  for (const bool fog : {false, true})
    for (const bool mapped : {false, true}) {
      tests::SceneRig rig(24, 16);
      if (mapped) rig.addLight(LightKind::Spot, tests::Casters::AllLit);
      rig.addLight(LightKind::Point, tests::Casters::None);
      rig.addLight(LightKind::Directional, tests::Casters::None);
      rig.frame.medium = fog ? layered() : haze();
      rig.frame.ambient.radiance = {0.5F, 0.6F, 0.7F};
      rig.frame.ambient.harmonics[1] = {0.2F, 0.2F, 0.2F};
      rig.frame.settings.technique = Technique::Tree;
      tests::ShaftsLookup layers(24, 16, 32, kRange);
      layers.enter(rig.frame);
      rig.render();
      for (int layer = 0; layer < 32; layer += 5) {
        const reference::ImageAnswer truth = cutAt(rig, layers.distance(layer));
        CAPTURE(fog, mapped, layer);
        CHECK(tests::difference(layers.light(layer), truth.inscatter) <= 2e-4);
        CHECK(tests::difference(layers.passed(layer), truth.transmittance) <= 1e-6);
      }
    }
}

TEST_CASE("cascades that fade, and the faces of a lamp, come into a look-up whole") {
  tests::ShaftRig rig(kWidth, kHeight);
  Light sun = tests::shaftLight(LightKind::Directional);
  sun.shadow.views = tests::shadowViews(sun, 3);
  sun.cascadeFade = 0.2;
  rig.addLight(sun, 128);
  rig.addLight(tests::shaftLight(LightKind::Point), 128);
  Frame& frame = rig.scene.frame;
  frame.medium = haze();
  frame.settings.technique = Technique::Epipolar;
  tests::ShaftsLookup layers(kWidth, kHeight, 9, kRange);
  layers.enter(frame);
  rig.scene.render();
  checkAsTree(rig.scene, layers, 7, 1.1, 1e-3);
}

TEST_CASE("what a shader looks up at any distance is what a frame that ends there has") {
  tests::ShaftRig rig(kWidth, kHeight);
  rig.addLight(tests::shaftLight(LightKind::Directional), 128);
  Frame& frame = rig.scene.frame;
  frame.medium = haze();
  frame.settings.technique = Technique::Epipolar;
  tests::ShaftsLookup layers(kWidth, kHeight, 32, kRange);
  layers.enter(frame);
  rig.scene.render();
  const reference::Image last = layers.at(kFar, kWidth, kHeight).inscatter;
  for (const double distance : {0.2, 0.5, 1.7, 5.3, 13.0, 39.9}) {
    const reference::ImageAnswer truth = cutAt(rig.scene, distance), tree = cutAt(rig.scene, distance, Technique::Tree);
    const reference::ImageAnswer got = layers.at(distance, kWidth, kHeight);
    const double floor = reference::compare(tree.inscatter, truth.inscatter).rRmse;
    CAPTURE(distance, floor);
    CHECK(reference::compare(got.inscatter, truth.inscatter).rRmse <= 1.1 * floor + 0.01);
    CHECK(tests::difference(got.transmittance, truth.transmittance) <= 5e-3);
  }
  CHECK(layers.at(1e9, kWidth, kHeight).inscatter.rgb == last.rgb);
  const reference::ImageAnswer atEye = layers.at(0, kWidth, kHeight);
  CHECK(meanOf(atEye.inscatter) == 0);
  CHECK(meanOf(atEye.transmittance) == 1);
}

TEST_CASE("a look-up of few texels is about as bright as one of many, whatever its size and format") {
  tests::ShaftRig rig(kWidth, kHeight);
  rig.addLight(tests::shaftLight(LightKind::Spot), 128);
  Frame& frame = rig.scene.frame;
  frame.medium = haze();
  frame.settings.technique = Technique::Epipolar;
  const double truth = meanOf(cutAt(rig.scene, kFar).inscatter);
  for (const auto& [width, height, depths] :
       {std::tuple{32, 20, 2}, std::tuple{200, 133, 3}, std::tuple{48, 32, 64}, std::tuple{96, 64, 17}})
    for (const GLenum format : {GL_RGBA16F, GL_R11F_G11F_B10F}) {
      tests::ShaftsLookup layers(width, height, depths, kRange, format);
      layers.enter(frame);
      rig.scene.render();
      CAPTURE(width, height, depths, format);
      CHECK(meanOf(layers.light(depths - 1)) == Approx(truth).epsilon(0.06));
    }
  tests::ShaftsLookup one(1, 1, 2, kRange); // a single ray
  one.enter(frame);
  rig.scene.render();
  CHECK(meanOf(one.light(1)) > 0);
  CHECK(meanOf(one.light(1)) < 20 * truth);
}

TEST_CASE("a frame with a look-up is the frame without one, and where nothing is added the look-up is empty") {
  tests::SceneRig rig = tests::threeLights();
  rig.frame.medium = haze();
  for (const Technique technique : {Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
    rig.frame.settings.technique = technique;
    rig.frame.lookup = {};
    const reference::ImageAnswer without = rig.render();
    tests::ShaftsLookup layers(16, 16, 8, kRange);
    layers.enter(rig.frame);
    const reference::ImageAnswer with = rig.render();
    CAPTURE(static_cast<int>(technique));
    CHECK(with.inscatter.rgb == without.inscatter.rgb);
    CHECK(with.transmittance.rgb == without.transmittance.rgb);
    CHECK(isDrawn(tests::testEffect().statistics(), "light 0 look-up"));
  }
  tests::ShaftsLookup layers(16, 16, 8, kRange);
  layers.enter(rig.frame);
  rig.frame.lights.clear();
  rig.render();
  CHECK(meanOf(layers.light(7)) == 0);
  CHECK(meanOf(layers.passed(7)) < 1);
  rig.frame.medium = {}; // clear air, and nowhere to draw to but colour
  const std::vector<float> back(static_cast<std::size_t>(4 * rig.frame.viewport.width * rig.frame.viewport.height),
                                0.5F);
  const host::GlTexture colour = rig.makeColour(GL_RGBA32F, back);
  rig.frame.output = {};
  tests::ShaftsLookup clear(16, 16, 8, kRange);
  clear.enter(rig.frame);
  REQUIRE(tests::testEffect().render(rig.frame));
  CHECK(meanOf(clear.light(7)) == 0);
  CHECK(meanOf(clear.passed(0)) == 1);
  CHECK(host::readColour(colour.name(), rig.frame.viewport.width, rig.frame.viewport.height) == back);
}

TEST_CASE("under reuse a look-up is that of a frame in full, and where nothing has changed it is left alone") {
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    tests::ShaftRig rig = tests::reuse::sunlit(changes);
    rig.addLight(tests::reuse::spot(), 64);
    rig.scene.frame.lights[1].shadow.version = 7;
    Frame& frame = rig.scene.frame;
    frame.medium = haze();
    tests::ShaftsLookup kept(64, 48, 8, kRange), whole(64, 48, 8, kRange);
    for (int i = 0; i < 4; ++i) {
      CAPTURE(static_cast<int>(changes), i);
      tests::reuse::moveTo(rig, i);
      ++frame.depth.version;
      for (Light& light : frame.lights)
        ++light.shadow.version;
      kept.enter(frame);
      const tests::reuse::Picture picture = tests::reuse::reused(rig);
      whole.enter(frame);
      tests::reuse::full(rig);
      CHECK(tests::difference(kept.light(6), whole.light(6)) <= 1e-5);
      if (i > 1) CHECK((picture.share > 0 && picture.share < 1));
    }
    kept.enter(frame);
    ++frame.reuse.frame;
    frame.objects.clear();
    rig.scene.render();
    const reference::Image last = kept.light(6);
    ++frame.reuse.frame;
    rig.scene.render();
    CHECK_FALSE(isDrawn(tests::testEffect().statistics(), "look-up sums"));
    CHECK(kept.light(6).rgb == last.rgb);
    whole.enter(frame); // other textures: nothing is in them
    ++frame.reuse.frame;
    rig.scene.render();
    CHECK(isDrawn(tests::testEffect().statistics(), "look-up sums"));
    CHECK(tests::difference(whole.light(6), last) <= 1e-6);
  }
}

TEST_CASE("a look-up is the same light whatever else of a frame is not plain") {
  struct Row {
    const char* name;
    std::function<void(tests::ShaftRig&)> change;
    double more = 1.15; // than the tree's error
  };
  const std::vector<Row> rows = {
      {"orthographic",
       [](tests::ShaftRig& rig) {
         tests::DepthConvention parallel = rig.scene.convention();
         parallel.orthographic = true;
         rig.setConvention(parallel);
       }},
      {"multisampled",
       [](tests::ShaftRig& rig) {
         const std::vector<float> depth = rig.scene.depth();
         rig.scene.setMultisampledDepth(4, GL_DEPTH_COMPONENT32F, [&](int pixel, int sample) {
           return depth[(static_cast<std::size_t>(pixel) + static_cast<std::size_t>(sample)) % depth.size()];
         });
       }},
      // Of fewer slices, which are farther away.
      {"error target", [](tests::ShaftRig& rig) { rig.scene.frame.settings.errorTarget = 0.001F; }, 1.5},
      {"spread", [](tests::ShaftRig& rig) { rig.scene.frame.settings.spreadThreshold = 0.02F; }},
      {"no tree", [](tests::ShaftRig& rig) { rig.scene.frame.settings.minMaxTree = false; }},
      {"boundary", [](tests::ShaftRig& rig) { rig.scene.frame.lights[0].boundary = {true, {0, 9, 0}, {0, 1, 0.1}}; }},
  };
  for (const Row& row : rows) {
    tests::ShaftRig rig(kWidth, kHeight);
    rig.addLight(tests::shaftLight(LightKind::Directional), 128);
    Frame& frame = rig.scene.frame;
    frame.medium = haze();
    frame.settings.technique = Technique::Epipolar;
    row.change(rig);
    tests::ShaftsLookup layers(kWidth, kHeight, 8, {1, 20});
    layers.enter(frame);
    REQUIRE(tests::testEffect().render(frame));
    CAPTURE(row.name);
    checkAsTree(rig.scene, layers, 6, row.more, 2e-3);
    const reference::Image passed = cutAt(rig.scene, layers.distance(6)).transmittance;
    CHECK(tests::difference(layers.passed(6), passed) <= 1e-5);
  }
}

TEST_CASE(
    "a look-up is filled in a frame that else wants its transmittance only, and of its two parts what is asked for") {
  tests::SceneRig rig = tests::threeLights();
  rig.frame.medium = haze();
  rig.frame.ambient.radiance = {0.1F, 0.2F, 0.3F};
  rig.frame.settings.technique = Technique::Tree;
  tests::ShaftsLookup wanted(16, 16, 5, kRange), layers(16, 16, 5, kRange), half(16, 16, 5, kRange);
  wanted.enter(rig.frame);
  rig.render();
  const std::uint32_t inscatter = std::exchange(rig.frame.output.inscatter, 0);
  layers.enter(rig.frame);
  REQUIRE(tests::testEffect().render(rig.frame));
  CHECK(tests::difference(layers.light(4), wanted.light(4)) <= 1e-6);
  CHECK(layers.passed(4).rgb == wanted.passed(4).rgb);
  rig.frame.output.inscatter = inscatter;
  half.enter(rig.frame);
  rig.frame.lookup.inscatter = 0;
  rig.render();
  CHECK(half.passed(4).rgb == wanted.passed(4).rgb);
  CHECK(meanOf(half.light(4)) == 7); // as it was
  CHECK_FALSE(isDrawn(tests::testEffect().statistics(), "light 0 look-up"));
}

TEST_CASE("a look-up that something else has written since the eye's last frame is drawn anew, and no slice is") {
  tests::ShaftRig rig = tests::reuse::sunlit(Changes::Detect);
  Frame& frame = rig.scene.frame;
  frame.medium = haze();
  tests::ShaftsLookup layers(32, 24, 6, kRange), others(32, 24, 6, {0.5, 30});
  layers.enter(frame);
  const auto next = [&] {
    ++frame.reuse.frame;
    rig.scene.render();
    return tests::testEffect().statistics();
  };
  next();
  const reference::Image light = layers.light(5);
  CHECK_FALSE(isDrawn(next(), "look-up sums"));
  const Frame last = frame;
  frame.reuse = {}; // of another medium, and kept by no eye
  frame.medium.constituents[0].scattering = {};
  rig.scene.render();
  CHECK(meanOf(layers.light(5)) == 0);
  frame = last;
  const Statistics again = next();
  CHECK(isDrawn(again, "look-up sums"));
  CHECK(again.redrawnShare == 0);
  CHECK(tests::difference(layers.light(5), light) <= 1e-6);
  others.enter(frame);
  const Statistics other = next();
  CHECK(isDrawn(other, "look-up sums"));
  CHECK(other.redrawnShare == 0);
  frame.lookup = {};
  CHECK(next().redrawnShare == 0);
  others.enter(frame);
  next();
  CHECK_FALSE(isDrawn(next(), "look-up sums"));
}

TEST_CASE("faces of a lamp that are marched one after the other come into a look-up whole") {
  const tests::FrameCase& parts = tests::frameCase("tree, look-up, lamp in parts");
  tests::FaultyContext context;
  context.setMaxTextureSize(parts.maxTextureSize);
  tests::Stage stage(parts);
  const CreateResult created = context.create();
  REQUIRE(created.status);
  const tests::TargetContents inParts = stage.draw(*created.effect), whole = stage.draw(tests::testEffect());
  REQUIRE(inParts.size() == whole.size());
  double most = 0;
  for (std::size_t i = 3; i < whole.size(); ++i) // behind colour and outputs
    for (std::size_t k = 0; k < whole[i].size(); ++k) {
      most = std::max(most, static_cast<double>(whole[i][k]));
      CHECK(static_cast<double>(inParts[i][k]) == Approx(static_cast<double>(whole[i][k])).epsilon(0.02).margin(1e-5));
    }
  CHECK(most > 0);
}

TEST_CASE("a look-up that breaks a rule is refused by field") {
  tests::RefusalRig rig;
  rig.frame.settings.technique = Technique::Tree;
  const host::GlTexture good = host::makeTextureArray(GL_RGBA16F, 8, 4, 5);
  const host::GlTexture other = host::makeTextureArray(GL_RGBA16F, 8, 4, 5);
  rig.frame.lookup = {good.name(), other.name(), 1, 10};
  rig.checkAccepted(rig.frame);
  const auto refused = [&](const auto& change, const std::vector<std::string>& mentions) {
    Frame broken = rig.frame;
    change(broken);
    rig.checkRefused(broken, mentions);
  };
  for (const double distance : {0.0, -1.0, std::nan(""), kInfinity, 1e-40, 1e31})
    refused([&](Frame& f) { f.lookup.nearDistance = distance; }, {"Frame::lookup.nearDistance", "finite and > 0"});
  for (const double distance : {0.0, 1.0, -2.0, std::nan(""), kInfinity, 1e31, 1.00001, 2e12})
    refused([&](Frame& f) { f.lookup.farDistance = distance; }, {"Frame::lookup.farDistance", "> nearDistance"});
  refused([](Frame& f) { f.settings.technique = Technique::Exact; }, {"Frame::settings.technique", "needs slices"});
  refused([](Frame& f) { f.lookup.transmittance = f.lookup.inscatter; },
          {"Frame::lookup.transmittance", "must differ"});
  const auto replaced = [&](GLenum format, int width, int height, int layers, const std::string& rule) {
    const host::GlTexture texture = host::makeTextureArray(format, width, height, layers);
    CAPTURE(format, width, height, layers);
    refused([&](Frame& f) { f.lookup.transmittance = texture.name(); }, {"Frame::lookup.transmittance", rule});
    if (rule.find("8 x 4") == std::string::npos && rule.find("lookup.inscatter") == std::string::npos)
      refused([&](Frame& f) { f.lookup.inscatter = texture.name(); }, {"Frame::lookup.inscatter", rule});
  };
  replaced(GL_RGBA8, 8, 4, 5, "must have a float colour format");
  replaced(GL_R32F, 8, 4, 5, "must have a float colour format");
  replaced(GL_RGBA16F, 513, 1, 2, "must be 512 x 512 at most");
  replaced(GL_RGBA16F, 1, 513, 2, "must be 512 x 512 at most");
  replaced(GL_RGBA16F, 8, 4, 1, "must have 2 to 64");
  replaced(GL_RGBA16F, 8, 4, 65, "must have 2 to 64");
  replaced(GL_RGBA16F, 9, 4, 5, "must be 8 x 4");
  replaced(GL_RGBA16F, 8, 4, 6, "lookup.inscatter 5");
  const host::GlTexture flat = host::makeTexture2D(GL_RGBA16F, 8, 4);
  refused([&](Frame& f) { f.lookup.inscatter = flat.name(); },
          {"Frame::lookup.inscatter", "must be a GL_TEXTURE_2D_ARRAY"});
  refused([&](Frame& f) { f.lookup.inscatter = 123456789; }, {"Frame::lookup.inscatter", "not the name of a texture"});
  rig.frame.lookup.transmittance = 0; // one of the two is enough
  rig.checkAccepted(rig.frame);
  std::swap(rig.frame.lookup.inscatter, rig.frame.lookup.transmittance);
  rig.checkAccepted(rig.frame);
}
