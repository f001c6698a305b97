// What must cancel, mirror or add up, without a reference: glass that tints nothing, maps all lit and all dark,
// mirrored scenes, a shadow map and its complement.
#include "SceneRig.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace {

const std::vector<LightKind> kKinds = {LightKind::Directional, LightKind::Point, LightKind::Spot};

template <typename Check>
void forEveryLightAndFilter(Check&& check) {
  for (const LightKind kind : kKinds)
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CAPTURE(static_cast<int>(kind), static_cast<int>(filter));
      tests::SceneRig rig;
      rig.frame.settings.shadowFilter = filter;
      check(rig, kind);
    }
}

// A light whose near plane no camera ray reaches, so that the map alone decides.
Light& addHighLight(tests::SceneRig& rig, LightKind kind, tests::Casters casters) {
  Light& light = rig.addLight(kind, casters);
  light.position = {-0.7, 5, 0.4};
  light.litOutsideViews = kind != LightKind::Spot; // the cone lies inside the view but for rounding
  if (casters != tests::Casters::None) light.shadow.views = tests::shadowViewsOf(light);
  return light;
}

reference::Image mirrored(const reference::Image& image) {
  reference::Image result(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      result.set(x, y, image.at(image.width - 1 - x, y));
  return result;
}

std::vector<float> flippedRows(const std::vector<float>& values, int width, int channels) {
  std::vector<float> result(values.size());
  const std::size_t stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  for (std::size_t row = 0; row < values.size() / stride; ++row)
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x)
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
        result[row * stride + x * static_cast<std::size_t>(channels) + c] =
            values[row * stride + (static_cast<std::size_t>(width) - 1 - x) * static_cast<std::size_t>(channels) + c];
  return result;
}

} // namespace

TEST_CASE("glass that lets everything through equals no glass") {
  forEveryLightAndFilter([](tests::SceneRig& rig, LightKind kind) {
    rig.addLight(kind, tests::Casters::Blocks, true);
    reference::ShadowImage image = rig.shadow(0);
    std::fill(image.glassColour.begin(), image.glassColour.end(), 1.0F);
    rig.setShadow(0, image);
    const reference::ImageAnswer glazed = rig.render();
    rig.frame.lights[0].glass = {};
    CHECK(tests::difference(glazed.inscatter, rig.render().inscatter) <= 1e-6);
  });
}

TEST_CASE("glass whose texture gives its channels in another order equals glass stored so", "[sweep]") {
  for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    tests::SceneRig rig;
    rig.addLight(LightKind::Directional, tests::Casters::Blocks, true);
    rig.frame.settings.technique = technique;
    const reference::ImageAnswer plain = rig.render();
    reference::ShadowImage image = rig.shadow(0);
    for (std::size_t i = 0; i < image.glassColour.size(); i += 3)
      std::swap(image.glassColour[i], image.glassColour[i + 2]);
    rig.setShadow(0, image);
    CHECK(tests::difference(rig.render().inscatter, plain.inscatter) > 1e-2);
    host::gl().BindTexture(GL_TEXTURE_2D_ARRAY, rig.frame.lights[0].glass.colour);
    host::gl().TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    host::gl().TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_SWIZZLE_B, GL_RED);
    CHECK(rig.render().inscatter == plain.inscatter);
  }
}

TEST_CASE("a tint that is stored as sRGB equals the same in linear numbers", "[sweep]") {
  for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
    CAPTURE(static_cast<int>(technique));
    tests::SceneRig rig;
    Light& light = rig.addLight(LightKind::Directional, tests::Casters::Blocks, true);
    rig.frame.settings.technique = technique;
    reference::ShadowImage image = rig.shadow(0);
    std::vector<float> codes = image.glassColour; // of 8 bits
    for (std::size_t i = 0; i < codes.size(); ++i) {
      codes[i] = std::round(255 * codes[i]) / 255;
      image.glassColour[i] = codes[i] <= 0.04045F ? codes[i] / 12.92F : std::pow((codes[i] + 0.055F) / 1.055F, 2.4F);
    }
    rig.setShadow(0, image);
    const reference::ImageAnswer linear = rig.render();
    const host::GlTexture tint = host::makeTextureArray(GL_SRGB8, image.width, image.height, image.layers);
    host::gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    host::gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, image.width, image.height, image.layers, GL_RGB, GL_FLOAT,
                             codes.data());
    light.glass.colour = tint.name();
    // GL may decode to so many digits; epipolar's averages and half floats may round the two apart.
    const double limit = technique == Technique::Exact ? 2e-4 : std::pow(2.0, -10);
    CHECK(tests::difference(rig.render().inscatter, linear.inscatter) <= limit);
  }
}

TEST_CASE("black glass equals a caster where the glass is") {
  forEveryLightAndFilter([](tests::SceneRig& rig, LightKind kind) {
    rig.addLight(kind, tests::Casters::AllLit, true);
    reference::ShadowImage image = rig.shadow(0);
    for (std::size_t i = 0; i < image.glassColour.size(); ++i)
      image.glassColour[i] = image.glassDepth[i / 3] < 1 ? 0.0F : 1.0F;
    rig.setShadow(0, image);
    const reference::ImageAnswer glazed = rig.render();
    rig.frame.lights[0].glass = {};
    reference::ShadowImage opaque = image;
    opaque.depth = image.glassDepth;
    opaque.glassColour.clear();
    opaque.glassDepth.clear();
    rig.setShadow(0, opaque);
    CHECK(tests::difference(glazed.inscatter, rig.render().inscatter) <= 1e-6);
  });
}

TEST_CASE("a map without casters equals no map") {
  forEveryLightAndFilter([](tests::SceneRig& rig, LightKind kind) {
    addHighLight(rig, kind, tests::Casters::AllLit).litOutsideViews = true;
    const reference::ImageAnswer mapped = rig.render();
    rig.frame.lights[0].shadow = {};
    // The faces of a point light divide the ray, and with it the quadrature.
    CHECK(tests::difference(mapped.inscatter, rig.render().inscatter) <= (kind == LightKind::Point ? 1e-5 : 1e-6));
  });
}

TEST_CASE("a map that blocks everything leaves no light") {
  forEveryLightAndFilter([](tests::SceneRig& rig, LightKind kind) {
    Light& light = addHighLight(rig, kind, tests::Casters::AllDark);
    light.litOutsideViews = false;
    const reference::ImageAnswer answer = rig.render();
    CHECK(answer.inscatter.rgb == std::vector<double>(answer.inscatter.rgb.size(), 0));
    light.shadow = {};
    CHECK(tests::difference(rig.render().transmittance, answer.transmittance) <= 1e-7);
  });
}

TEST_CASE("a shadow map and its complement add up to the unshadowed light") {
  forEveryLightAndFilter([](tests::SceneRig& rig, LightKind kind) {
    Light& light = addHighLight(rig, kind, tests::Casters::Blocks);
    light.litOutsideViews = false;
    rig.frame.medium.farDistance = 12; // inside the views
    reference::ShadowImage image = rig.shadow(0);
    for (float& depth : image.depth)
      depth = depth < 1 ? 0.0F : 1.0F;
    rig.setShadow(0, image);
    const reference::ImageAnswer one = rig.render();
    for (float& depth : image.depth)
      depth = 1 - depth;
    rig.setShadow(0, image);
    reference::Image sum = rig.render().inscatter;
    CHECK(tests::difference(one.inscatter, sum) > 0.1); // or the map decides nothing
    for (std::size_t i = 0; i < sum.rgb.size(); ++i)
      sum.rgb[i] += one.inscatter.rgb[i];
    light.shadow = {};
    CHECK(tests::difference(sum, rig.render().inscatter) <= 2e-5);
  });
}

TEST_CASE("a mirrored scene gives the mirrored picture, with the map's texels mirrored or not") {
  const glm::dmat4 mirror = {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (const bool mirrorTexels : {false, true})
    forEveryLightAndFilter([&](tests::SceneRig& rig, LightKind kind) {
      CAPTURE(mirrorTexels);
      Light& light = rig.addLight(kind, tests::Casters::Blocks, true);
      const reference::ImageAnswer expected = rig.render();
      light.direction[0] *= -1;
      light.position[0] *= -1;
      for (ShadowView& view : light.shadow.views) {
        const glm::dmat4 clip = reference::toMat4(view.clipFromWorld) * mirror;
        view.clipFromWorld = tests::toMat4(mirrorTexels ? mirror * clip : clip);
      }
      if (mirrorTexels) {
        reference::ShadowImage image = rig.shadow(0);
        image.depth = flippedRows(image.depth, image.width, 1);
        image.glassDepth = flippedRows(image.glassDepth, image.width, 1);
        image.glassColour = flippedRows(image.glassColour, image.width, 3);
        rig.setShadow(0, image);
      }
      rig.frame.camera.viewFromWorld =
          tests::toMat4(mirror * reference::toMat4(rig.frame.camera.viewFromWorld) * mirror);
      std::reverse(rig.distances.begin(), rig.distances.end()); // both ways, then rows back
      for (int y = 0; y < rig.frame.viewport.height / 2; ++y)
        std::swap_ranges(rig.distances.begin() + y * rig.frame.viewport.width,
                         rig.distances.begin() + (y + 1) * rig.frame.viewport.width,
                         rig.distances.begin() + (rig.frame.viewport.height - 1 - y) * rig.frame.viewport.width);
      rig.setConvention(rig.convention());
      const reference::ImageAnswer answer = rig.render();
      CHECK(tests::difference(mirrored(answer.inscatter), expected.inscatter) <= 2e-5);
      CHECK(tests::difference(mirrored(answer.transmittance), expected.transmittance) <= 1e-6);
    });
}
