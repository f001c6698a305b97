// What drivers do otherwise: what is undefined, such as the texels of a new texture, and how they run lanes that part.
// The cases with the tag are drawn by Mesa's softpipe, too (tests/gl/CMakeLists.txt).
#include "FakeContext.h"
#include "ReuseRig.h"
#include "gl/ReadBack.h"

#include <limits>

using namespace tyndall;

namespace {

struct Case {
  LightKind kind;
  int cascades;
  double fade;
  ShadowFilter filter;
  bool glass;
};

constexpr Case kCases[] = {{LightKind::Directional, 1, 0, ShadowFilter::Nearest, false},
                           {LightKind::Directional, 3, 0.2, ShadowFilter::Nearest, true},
                           {LightKind::Directional, 2, 0, ShadowFilter::Bilinear, false},
                           {LightKind::Spot, 1, 0, ShadowFilter::Nearest, false},
                           {LightKind::Spot, 1, 0, ShadowFilter::Bilinear, true},
                           {LightKind::Point, 1, 0, ShadowFilter::Nearest, false}};
constexpr Technique kTechniques[] = {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank};

void addLight(tests::ShaftRig& rig, const Case& item) {
  Light light = tests::shaftLight(item.kind);
  light.shadow.views = tests::shadowViews(light, item.cascades);
  light.cascadeFade = item.fade;
  rig.addLight(light, 64, item.glass);
  rig.scene.frame.settings.shadowFilter = item.filter;
}

void capture(const Case& item) {
  UNSCOPED_INFO("kind " << static_cast<int>(item.kind) << ", cascades " << item.cascades << ", filter "
                        << static_cast<int>(item.filter) << ", glass " << item.glass);
}

// What glTexImage2D leaves undefined: not a number, or, where the format cannot hold that, nearly one.
void GLAD_API_PTR poisonTexture(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                                GLenum channels, GLenum type, const void* data) {
  const bool normalised = format == GL_RG16 || format == GL_RGBA16;
  const float poison = normalised ? 0.97F : std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), poison);
  const bool undefined = data == nullptr && type == GL_FLOAT;
  host::gl().TexImage2D(target, level, format, width, height, border, channels, type, undefined ? values.data() : data);
}

// A picture by new textures: those of the frame before are given up by a frame that needs none.
std::vector<double> freshPicture(tests::SceneRig& scene, Effect& effect) {
  Frame none = scene.frame;
  none.lights.clear();
  none.reuse = {};
  none.objects.clear();
  REQUIRE(effect.render(none));
  return scene.render(effect).inscatter.rgb;
}

struct Poisoned {
  tests::FakeContext context{{}, {{"glTexImage2D", tests::address(poisonTexture)}}};
  CreateResult created = context.create();
};

} // namespace

// Every first pixel of a quad has no ray: its depth is not a number.
TEST_CASE("pixels that leave a loop before their neighbours leave those alone", "[sweep][softpipe]") {
  const tests::PixelSet others = [](int x, int y) { return x % 2 != 0 || y % 2 != 0; };
  for (const Case& item : kCases) {
    tests::ShaftRig rig(48, 32);
    addLight(rig, item);
    const reference::Image truth = rig.truth();
    const std::vector<float> depth = rig.scene.depth();
    std::vector<float> holed = depth;
    for (std::size_t i = 0; i < holed.size(); ++i)
      if (i % 2 == 0 && i / 48 % 2 == 0) holed[i] = std::numeric_limits<float>::quiet_NaN();
    for (const Technique technique : kTechniques) {
      capture(item);
      CAPTURE(static_cast<int>(technique));
      rig.scene.setDepth(depth);
      const reference::Image expected = rig.picture(technique);
      rig.scene.setDepth(holed);
      const reference::Image image = rig.picture(technique);
      if (technique == Technique::Epipolar) // a hole is a break, at which other samples are marched
        CHECK(tests::errorWhere(image, truth, others) <= 2 * tests::errorWhere(expected, truth, others));
      else
        CHECK(tests::errorWhere(image, expected, others) == 0);
    }
  }
}

TEST_CASE("nothing is read that no pass has written", "[once]") {
  Poisoned poisoned;
  REQUIRE(poisoned.created.effect);
  for (const Case& item : kCases)
    for (const float spread : {std::numeric_limits<float>::infinity(), 0.02F}) {
      tests::ShaftRig rig(48, 32);
      addLight(rig, item);
      rig.scene.frame.settings.spreadThreshold = spread;
      for (const Technique technique : kTechniques) {
        if (std::isfinite(spread) && technique != Technique::Epipolar) continue;
        capture(item);
        CAPTURE(static_cast<int>(technique), spread);
        rig.scene.frame.settings.technique = technique;
        CHECK(freshPicture(rig.scene, *poisoned.created.effect) == freshPicture(rig.scene, tests::testEffect()));
      }
    }
}

TEST_CASE("nothing is kept that no pass has written", "[once]") {
  Poisoned poisoned;
  REQUIRE(poisoned.created.effect);
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const Case& item : kCases) {
      capture(item);
      CAPTURE(static_cast<int>(changes));
      tests::ShaftRig rig(48, 32);
      addLight(rig, item);
      tests::reuse::begin(rig, changes);
      for (int frame = 0; frame < 4; ++frame) {
        CAPTURE(frame);
        tests::reuse::moveTo(rig, frame);
        const std::vector<double> expected = rig.scene.render().inscatter.rgb;
        CHECK(rig.scene.render(*poisoned.created.effect).inscatter.rgb == expected);
      }
    }
}

TEST_CASE("debug views read nothing that no pass has written") {
  Poisoned poisoned;
  REQUIRE(poisoned.created.effect);
  tests::ShaftRig rig(48, 32);
  addLight(rig, kCases[0]);
  rig.scene.frame.settings.technique = Technique::Epipolar;
  for (int view = 0; view <= static_cast<int>(DebugView::Inputs); ++view) {
    CAPTURE(view);
    rig.scene.frame.settings.debugView = static_cast<DebugView>(view);
    std::vector<std::vector<float>> pictures;
    for (Effect* effect : {poisoned.created.effect.get(), &tests::testEffect()}) {
      const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, std::vector<float>(4 * 48 * 32, 0.5F));
      freshPicture(rig.scene, *effect);
      pictures.push_back(host::readColour(colour.name(), 48, 32));
    }
    CHECK(pictures[0] == pictures[1]);
  }
}
