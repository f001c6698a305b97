// Tunings (Config::tuning): whichever is chosen, the picture is the same.
#include "FakeContext.h"
#include "FaultyContext.h"
#include "FrameCases.h"
#include "ReuseRig.h"
#include "gl/ReadBack.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace tyndall;
using host::gl;
using tests::FakeContext;
using tests::FaultyContext;
using tests::FrameCase;
using tests::Stage;

namespace {

constexpr Masking kStencil = Masking::Stencil, kTiles = Masking::Tiles;
constexpr Tuning kMasks[] = {{kTiles, kStencil}, {kTiles, kTiles}, {kStencil, kStencil}, {kStencil, kTiles}};
constexpr Tuning kDualSource{{}, {}, Compositing::DualSource}, kCopy{{}, {}, Compositing::Copy};

std::unique_ptr<Effect> effectWith(const Tuning& tuning, GlLoader loader = nullptr) {
  return tests::newEffect({loader, PassTiming::Off, {}, StateMode::Restore, tuning});
}

std::vector<std::unique_ptr<Effect>> effectsByMask(GlLoader loader = nullptr) {
  std::vector<std::unique_ptr<Effect>> effects;
  for (const Tuning& tuning : kMasks)
    effects.push_back(effectWith(tuning, loader));
  return effects;
}

// Largest difference of the second from the first, relative to it.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
  double worst = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double error = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    worst =
        std::isfinite(error) ? std::max(worst, error / std::max(std::abs(static_cast<double>(a[i])), 1e-3)) : HUGE_VAL;
  }
  return worst;
}

bool hasRun(Effect& effect, const std::string& name) {
  const std::vector<PassStatistics> passes = effect.statistics().passes;
  return std::any_of(passes.begin(), passes.end(), [&](const PassStatistics& pass) {
    return pass.skipped.empty() && pass.name.find(name) != std::string::npos;
  });
}

} // namespace

namespace {

void checkMasks(const FrameCase& item, const std::vector<std::unique_ptr<Effect>>& effects) {
  CAPTURE(item.name);
  Stage stage(item, 80, 56);
  const std::vector<tests::TargetContents> expected = drawFrames(stage, *effects.front());
  for (std::size_t i = 1; i < effects.size(); ++i) {
    CAPTURE(i);
    CHECK(tests::same(drawFrames(stage, *effects[i]), expected));
  }
}

} // namespace

TEST_CASE("tuning: frames of every kind are the same bit for bit, whatever the masks", "[sweep]") {
  FaultyContext context;
  std::vector<std::unique_ptr<Effect>> effects = effectsByMask(context.loader());
  int textureSize = 0;
  for (const FrameCase& item : tests::frameCases()) {
    if (item.technique != Technique::Epipolar || !tests::canDraw(item)) continue;
    if (item.view == DebugView::Redrawn) continue; // it shows the mask
    if (item.maxTextureSize != textureSize) {
      context.setMaxTextureSize(textureSize = item.maxTextureSize);
      effects = effectsByMask(context.loader());
    }
    checkMasks(item, effects);
  }
}

namespace {

struct Sequence {
  std::vector<Light> lights;
  bool glass = false;
  ShadowFilter filter = ShadowFilter::Nearest;
  int cascades = 1;
  float leastWeight = 0.01F;
};

Light lampInView() { return tests::reuse::lamp(LightKind::Point, {-0.6, 2.6, -6}, {0, -1, 0}); }

tests::ShaftRig rigOf(const Sequence& sequence, Changes changes) {
  tests::ShaftRig rig(96, 64);
  for (Light light : sequence.lights) {
    if (sequence.cascades > 1) light.shadow.views = tests::shadowViews(light, sequence.cascades);
    rig.addLight(light, 128, sequence.glass);
  }
  rig.scene.frame.settings.shadowFilter = sequence.filter;
  rig.scene.frame.settings.leastWeight = sequence.leastWeight;
  tests::reuse::begin(rig, changes);
  rig.scene.frame.reuse.fullShare = 1;
  return rig;
}

} // namespace

TEST_CASE("tuning: sequences are the same bit for bit, whatever the masks", "[sweep]") {
  using tests::reuse::point, tests::reuse::spot, tests::reuse::sun;
  const auto nearest = ShadowFilter::Nearest, bilinear = ShadowFilter::Bilinear;
  const std::vector<std::unique_ptr<Effect>> effects = effectsByMask();
  for (const Sequence& sequence :
       {Sequence{{sun()}}, Sequence{{sun()}, true}, Sequence{{sun()}, true, bilinear},
        Sequence{{sun()}, false, bilinear, 3}, Sequence{{spot()}}, Sequence{{spot()}, true, bilinear},
        Sequence{{point()}}, Sequence{{lampInView()}}, Sequence{{sun(), spot(), point()}},
        Sequence{{sun(), spot()}, false, nearest, 1, 0.7F}})
    for (const Changes changes : {Changes::Detect, Changes::Objects}) {
      CAPTURE(sequence.lights.size(), static_cast<int>(sequence.lights[0].kind), sequence.glass,
              static_cast<int>(sequence.filter), sequence.cascades, static_cast<int>(changes));
      tests::ShaftRig rig = rigOf(sequence, changes);
      int parts = 0;
      for (int frame = 0; frame < 8; ++frame) {
        CAPTURE(frame);
        tests::reuse::moveTo(rig, frame);
        const reference::ImageAnswer expected = rig.scene.render(*effects.front());
        const double share = effects.front()->statistics().redrawnShare;
        if (share > 0 && share < 1) ++parts;
        for (std::size_t i = 1; i < effects.size(); ++i) {
          CAPTURE(i);
          const reference::ImageAnswer picture = rig.scene.render(*effects[i]);
          CHECK(tests::same(picture.inscatter.rgb, expected.inscatter.rgb));
          CHECK(tests::same(picture.transmittance.rgb, expected.transmittance.rgb));
          CHECK(effects[i]->statistics().redrawnShare == share);
          CHECK(effects[i]->statistics().fixupPixels <= effects.front()->statistics().fixupPixels);
        }
      }
      CHECK(parts == 7);
      CHECK(hasRun(*effects[2], "changed pixels"));
      CHECK_FALSE(hasRun(*effects[0], "changed pixels"));
      CHECK(hasRun(*effects[1], "unserved tiles"));
      CHECK_FALSE(hasRun(*effects[0], "unserved tiles"));
    }
}

TEST_CASE("tuning: where most pixels are fixed up, the masks of the fix-up draw the same bit for bit") {
  const std::unique_ptr<Effect> byStencil = effectWith({{}, kStencil}), byTiles = effectWith({{}, kTiles});
  for (const float leastWeight : {0.01F, 0.5F, 1.0F})
    for (const float spread : {0.005F, 0.05F, static_cast<float>(kInfinity)}) {
      CAPTURE(leastWeight, spread);
      tests::ShaftRig rig = rigOf({{tests::reuse::sun(), tests::reuse::point()}}, Changes::Unknown);
      rig.scene.frame.settings.leastWeight = leastWeight;
      rig.scene.frame.settings.spreadThreshold = spread;
      const reference::ImageAnswer expected = rig.scene.render(*byStencil), picture = rig.scene.render(*byTiles);
      CHECK(tests::same(picture.inscatter.rgb, expected.inscatter.rgb));
      CHECK(tests::same(picture.transmittance.rgb, expected.transmittance.rgb));
      CHECK(byTiles->statistics().fixupPixels == byStencil->statistics().fixupPixels);
      if (spread < 0.01F) CHECK(byTiles->statistics().fixupPixels > 96 * 64 / 2);
    }
}

namespace {

// Two frames into a colour of a format, the second after a body has moved.
std::vector<std::vector<float>> coloursBy(Effect& effect, tests::ShaftRig& rig, GLenum format) {
  std::vector<float> back;
  for (int i = 0; i < 96 * 64; ++i)
    back.insert(back.end(), {0.01F + 0.1F * static_cast<float>(i % 7), 0.3F, 40, 0.125F * static_cast<float>(i % 9)});
  std::vector<std::vector<float>> pictures;
  rig.scene.frame.reuse.eye = tests::reuse::newView();
  rig.scene.frame.reuse.frame = 0;
  for (int frame = 0; frame < 2; ++frame) {
    tests::reuse::moveTo(rig, frame);
    const host::GlTexture colour = rig.scene.makeColour(format, back);
    Frame f = rig.scene.frame;
    f.output = {};
    const Status status = effect.render(f);
    INFO(status.message);
    REQUIRE(status);
    pictures.push_back(host::readColour(colour.name(), 96, 64));
    rig.scene.frame.colour = 0;
  }
  return pictures;
}

void checkComposites(Effect& blending, Effect& copying, tests::ShaftRig& rig, GLenum format, double most) {
  const auto blended = coloursBy(blending, rig, format), copied = coloursBy(copying, rig, format);
  CHECK(hasRun(copying, "copy colour"));
  CHECK_FALSE(hasRun(blending, "copy colour"));
  for (std::size_t i = 0; i < blended.size(); ++i) {
    CAPTURE(i);
    CHECK(difference(blended[i], copied[i]) <= most);
    for (std::size_t alpha = 3; alpha < blended[i].size(); alpha += 4)
      if (blended[i][alpha] != copied[i][alpha]) FAIL_CHECK("alpha of pixel " << alpha / 4);
  }
}

} // namespace

TEST_CASE("tuning: a copy that is blended in the shader composites as dual-source blending does", "[once]") {
  using tests::reuse::point, tests::reuse::spot, tests::reuse::sun;
  const std::unique_ptr<Effect> blending = effectWith(kDualSource), copying = effectWith(kCopy);
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
    for (const Sequence& sequence : {Sequence{{sun()}}, Sequence{{spot()}, true}, Sequence{{sun(), spot(), point()}}})
      for (const Changes changes : {Changes::Unknown, Changes::Objects}) {
        CAPTURE(static_cast<int>(technique), sequence.lights.size(), static_cast<int>(sequence.lights[0].kind),
                sequence.glass, static_cast<int>(changes));
        tests::ShaftRig rig = rigOf(sequence, changes);
        rig.scene.frame.settings.technique = technique;
        checkComposites(*blending, *copying, rig, GL_RGBA32F, 1e-6);
        if (technique != Technique::Epipolar) continue;
        // A copy is rounded to the format once, blending once a light.
        const double rounding = std::pow(2.0, -10) * static_cast<double>(sequence.lights.size());
        checkComposites(*blending, *copying, rig, GL_RGBA16F, rounding);
      }
}

TEST_CASE("tuning: spread, bright lights and a medium without lights are composited by a copy, too") {
  const std::unique_ptr<Effect> blending = effectWith(kDualSource), copying = effectWith(kCopy);
  tests::ShaftRig rig = rigOf({{tests::reuse::sun(), tests::reuse::spot()}}, Changes::Unknown);
  rig.scene.frame.settings.spreadThreshold = 0.02F;
  checkComposites(*blending, *copying, rig, GL_RGBA32F, 1e-6);
  rig.scene.frame.settings = {};
  for (Light& light : rig.scene.frame.lights)
    light.colour = {3e6F, 2e6F, 1e6F};
  checkComposites(*blending, *copying, rig, GL_RGBA32F, 1e-6);
  tests::ShaftRig unlit = rigOf({{}}, Changes::Unknown);
  checkComposites(*blending, *copying, unlit, GL_RGBA32F, 1e-6);
}

namespace {

// What a driver without dual-source blending would refuse.
int refused = 0;

bool isSecondSource(GLenum factor) {
  return factor == GL_SRC1_COLOR || factor == GL_SRC1_ALPHA || factor == GL_ONE_MINUS_SRC1_COLOR ||
         factor == GL_ONE_MINUS_SRC1_ALPHA;
}

void sayNone(GLenum name, GLint* value) {
  gl().GetIntegerv(name, value);
  if (name == GL_MAX_DUAL_SOURCE_DRAW_BUFFERS) *value = 0;
}

void knowNothing(GLenum name, GLint* value) {
  if (name == GL_MAX_DUAL_SOURCE_DRAW_BUFFERS)
    tests::setGlError(GL_INVALID_ENUM);
  else
    gl().GetIntegerv(name, value);
}

void takeSources(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
  std::string all;
  for (GLsizei i = 0; i < count; ++i)
    all += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i]))
                                      : std::string(texts[i]);
  const auto has = [&](const char* text) { return all.find(text) != std::string::npos; };
  if (has("index = 1") && !has("#define ONE_SOURCE 1") && !has("#define COPIED 1") && !has("#define COMPOSITE 0"))
    ++refused;
  gl().ShaderSource(shader, count, texts, lengths);
}

void blend(GLenum sourceRgb, GLenum destinationRgb, GLenum sourceAlpha, GLenum destinationAlpha) {
  for (const GLenum factor : {sourceRgb, destinationRgb, sourceAlpha, destinationAlpha})
    if (isSecondSource(factor)) ++refused;
  gl().BlendFuncSeparate(sourceRgb, destinationRgb, sourceAlpha, destinationAlpha);
}

void blendOne(GLuint buffer, GLenum sourceRgb, GLenum destinationRgb, GLenum sourceAlpha, GLenum destinationAlpha) {
  for (const GLenum factor : {sourceRgb, destinationRgb, sourceAlpha, destinationAlpha})
    if (isSecondSource(factor)) ++refused;
  gl().BlendFuncSeparatei(buffer, sourceRgb, destinationRgb, sourceAlpha, destinationAlpha);
}

} // namespace

TEST_CASE("tuning: a context without dual-source blending is asked for none, and draws what others do") {
  using tests::address;
  for (void* getIntegerv : {address(sayNone), address(knowNothing)}) {
    const FakeContext fake({}, {{"glGetIntegerv", getIntegerv},
                                {"glShaderSource", address(takeSources)},
                                {"glBlendFuncSeparate", address(blend)},
                                {"glBlendFuncSeparatei", address(blendOne)}});
    const std::unique_ptr<Effect> effect =
        tests::newEffect({fake.loader(), PassTiming::Off, {}, StateMode::Restore, kDualSource});
    CHECK(effect->statistics().tuning.compositing == Compositing::Copy);
    refused = 0;
    for (const char* name : {"epipolar", "epipolar, two lights, all targets", "epipolar, spread", "tree",
                             "exact, two lights", "low rank", "detect, a part", "view 9"}) {
      CAPTURE(name);
      Stage stage(tests::frameCase(name));
      const std::vector<tests::TargetContents> expected = drawFrames(stage, tests::testEffect());
      const std::vector<tests::TargetContents> drawn = drawFrames(stage, *effect);
      for (std::size_t i = 0; i < drawn.size(); ++i)
        for (std::size_t target = 0; target < drawn[i].size(); ++target) {
          CAPTURE(i, target);
          CHECK(difference(expected[i][target], drawn[i][target]) <= (target == 0 ? std::pow(2.0, -9) : 1e-6));
        }
    }
    CHECK(refused == 0);
  }
}

TEST_CASE("tuning: statistics tell what was taken, and the copy is counted among the bytes") {
  Stage stage(tests::frameCase("epipolar"));
  const std::unique_ptr<Effect> blending = effectWith(kDualSource), copying = effectWith(kCopy);
  CHECK(blending->statistics().tuning.compositing == Compositing::DualSource);
  CHECK(copying->statistics().tuning.compositing == Compositing::Copy);
  CHECK(copying->statistics().tuning.reuse != Masking::Auto);
  CHECK(copying->statistics().tuning.bandMilliseconds >= 0);
  stage.draw(*blending);
  stage.draw(*copying);
  const std::uint64_t pixels = 32 * 24; // inscatter and transmittance, and a copy in half floats
  CHECK(copying->statistics().bytes == blending->statistics().bytes + pixels * (16 + 16 + 8));
}
