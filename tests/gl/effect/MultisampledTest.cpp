// A multisampled depth through slices: against exact on the same samples, and against one depth a pixel.
#include "ReuseRig.h"
#include "gl/ReadBack.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tyndall;
using namespace tests::reuse;

namespace {

bool everywhere(int, int) { return true; }

// A scene whose samples lie side by side across a pixel, as they see it: a picture that is `samples` times as wide.
struct SampledRig {
  tests::ShaftRig rig;
  std::vector<float> fine;
  int samples;

  explicit SampledRig(LightKind kind, int count, bool glass = false) : rig(96, 64), samples(count) {
    tests::ShaftRig wide(96 * count, 64);
    wide.scene.frame.camera.clipFromView = rig.scene.frame.camera.clipFromView;
    wide.look(rig.scene.frame.camera.viewFromWorld);
    fine = wide.scene.depth();
    rig.addLight(kind == LightKind::Directional ? sun() : kind == LightKind::Spot ? spot() : point(), 128, glass);
  }
  void useSamples() {
    samples = rig.scene.setMultisampledDepth(samples, GL_DEPTH_COMPONENT32F, [this](int pixel, int sample) {
      return fine[static_cast<std::size_t>(samples * pixel + std::min(sample, samples - 1))]; // GL may give more
    });
  }
  reference::ImageAnswer draw(Technique technique) {
    rig.scene.frame.settings.technique = technique;
    return rig.scene.render();
  }
};

} // namespace

TEST_CASE("samples that differ: every technique is as near to exact on the same samples as it is with one a pixel",
          "[sweep]") {
  tests::testContext();
  GLint most = 0;
  host::gl().GetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &most);
  for (const int count : {2, 4, 8})
    for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
        if (count > most) continue;
        CAPTURE(count, static_cast<int>(kind), static_cast<int>(filter));
        SampledRig sampled(kind, count);
        sampled.rig.scene.frame.settings.shadowFilter = filter;
        std::vector<double> resolved;
        const std::vector<Technique> techniques = {Technique::Epipolar, Technique::Tree, Technique::LowRank};
        const reference::Image truth = sampled.draw(Technique::Exact).inscatter;
        for (const Technique technique : techniques)
          resolved.push_back(tests::errorWhere(sampled.draw(technique).inscatter, truth, everywhere));
        sampled.useSamples();
        const reference::ImageAnswer exact = sampled.draw(Technique::Exact);
        for (std::size_t i = 0; i < techniques.size(); ++i) {
          const reference::ImageAnswer answer = sampled.draw(techniques[i]);
          CAPTURE(static_cast<int>(techniques[i]), sampled.samples);
          CHECK(tests::errorWhere(answer.inscatter, exact.inscatter, everywhere) <= resolved[i] + 0.01);
          CHECK(tests::errorWhere(answer.transmittance, exact.transmittance, everywhere) <= 1e-3);
        }
      }
}

TEST_CASE("samples that are all the same give the picture of one depth a pixel, bit for bit", "[sweep]") {
  for (const Technique technique : {Technique::Epipolar, Technique::Tree, Technique::LowRank}) {
    CAPTURE(static_cast<int>(technique));
    SampledRig sampled(LightKind::Spot, 4);
    const std::vector<float> depth = sampled.rig.scene.depth();
    const reference::ImageAnswer one = sampled.draw(technique);
    sampled.rig.scene.setMultisampledDepth(4, GL_DEPTH_COMPONENT32F,
                                           [&](int pixel, int) { return depth[static_cast<std::size_t>(pixel)]; });
    const reference::ImageAnswer answer = sampled.draw(technique);
    CHECK(answer.inscatter.rgb == one.inscatter.rgb);
    CHECK(answer.transmittance.rgb == one.transmittance.rgb);
  }
}

TEST_CASE("light blended straight into colour is what outputs and a composite come to, of samples too") {
  for (const Technique technique : {Technique::Epipolar, Technique::Tree}) {
    CAPTURE(static_cast<int>(technique));
    SampledRig sampled(LightKind::Directional, 4, true);
    Light lamp = spot();
    sampled.rig.addLight(lamp, 128);
    sampled.useSamples();
    tests::SceneRig& scene = sampled.rig.scene;
    const std::vector<float> back(4 * 96 * 64, 0.5F);
    const reference::ImageAnswer parts = sampled.draw(technique);
    const host::GlTexture colour = scene.makeColour(GL_RGBA32F, back);
    Frame straight = scene.frame;
    straight.output = {};
    REQUIRE(tests::testEffect().render(straight));
    const std::vector<float> drawn = host::readColour(colour.name(), 96, 64, 3);
    double worst = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i)
      worst = std::max(worst, static_cast<double>(
                                  std::abs(drawn[i] - (0.5F * parts.transmittance.rgb[i] + parts.inscatter.rgb[i]))));
    CHECK(worst <= 1e-5);
  }
}

TEST_CASE("a sample that is no number stays in its pixel") {
  SampledRig sampled(LightKind::Directional, 4);
  sampled.useSamples();
  const reference::ImageAnswer before = sampled.draw(Technique::Epipolar);
  const int at = 96 * 30 + 40;
  sampled.rig.scene.setMultisampledDepth(sampled.samples, GL_DEPTH_COMPONENT32F, [&](int pixel, int sample) {
    if (pixel == at && sample == 1) return std::numeric_limits<float>::quiet_NaN();
    return sampled.fine[static_cast<std::size_t>(sampled.samples * pixel + sample)];
  });
  const reference::ImageAnswer after = sampled.draw(Technique::Epipolar);
  CHECK(tests::isFiniteAndNonNegative(after.inscatter));
  int changed = 0;
  for (std::size_t i = 0; i < after.inscatter.rgb.size(); i += 3)
    if (after.inscatter.rgb[i] != before.inscatter.rgb[i] && static_cast<int>(i / 3) != at) ++changed;
  CHECK(changed == 0);
}

TEST_CASE("a multisampled frame reuses its slices, and draws all pixels where anything has changed") {
  SampledRig sampled(LightKind::Directional, 4);
  sampled.useSamples();
  begin(sampled.rig, Changes::Objects);
  for (int frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    ++sampled.rig.scene.frame.reuse.frame;
    sampled.rig.scene.frame.objects.clear();
    if (frame > 1) sampled.rig.scene.frame.objects = {between(tumbling(0), tumbling(1))}; // that is not there
    const Picture picture = reused(sampled.rig);
    checkSame(picture, full(sampled.rig));
    CHECK(picture.share == (frame == 0 ? 1 : 0));
  }
}
