#include "gl/ReadBack.h"
#include "gl/SceneRenderer.h"
#include "gl/host/SmallScenes.h"
#include "scene/Error.h"
#include "support/Catch.h"
#include "support/TestContext.h"

using host::ClipConvention;
using tests::addMaterial;
using tests::addWall;
using tests::restPose;

namespace {

constexpr int kSize = 16;
constexpr std::size_t kMiddle = kSize / 2 * kSize + kSize / 2;

host::Material glassOf(const glm::vec3& colour, float transmission) {
  host::Material material;
  material.baseColour = glm::vec4(colour, 1);
  material.transmission = transmission;
  return material;
}

/// Half of the texture, u < 1/2, is transparent.
int addHalfTexture(host::Scene& scene) {
  scene.textures.push_back(
      {2, 1, {255, 255, 255, 0, 255, 255, 255, 255}, host::Wrap::ClampToEdge, host::Wrap::ClampToEdge});
  return static_cast<int>(scene.textures.size()) - 1;
}

std::vector<float> shadowOf(const host::Scene& scene, const tyndall::Light& light) {
  host::SceneRenderer renderer(scene);
  const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, kSize);
  return host::readDepthArray(maps.depth.name(), kSize, kSize, 0);
}

} // namespace

TEST_CASE("a shadow map holds the depth of the nearest caster, in every convention", "[shadow]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, -8, 2);
  addWall(scene, -4, 1);
  for (const ClipConvention& convention : tests::allConventions()) {
    if (!tests::supports(convention)) {
      WARN("skipped: the context lacks glClipControl for " << tests::nameOf(convention));
      continue;
    }
    INFO(tests::nameOf(convention));
    const float farDepth = convention.reversed ? 0.0F : 1.0F;
    const tyndall::Light lights[] = {tests::sunAlongZ(10, -1, -21, convention), tests::spotAtOrigin(1, 21, convention),
                                     tests::spotAtOrigin(1, tyndall::kInfinity, convention)};
    for (const tyndall::Light& light : lights) {
      const std::vector<float> depth = shadowOf(scene, light);
      const glm::dmat4 clipFromWorld = host::fromMat4(light.shadow.views[0].clipFromWorld);
      CHECK(depth[kMiddle] == Approx(tests::depthAt(clipFromWorld, convention.clipDepth, 4)).margin(3e-7));
      CHECK(depth[0] == farDepth);
    }
  }
  CHECK(shadowOf(scene, tests::sunAlongZ(10, -1, -21))[kMiddle] == Approx(3.0 / 20)); // (4 - 1) / (21 - 1)
}

TEST_CASE("casters before a directional light's near plane are flattened onto it", "[shadow]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, 5, 2);
  addWall(scene, -8, 2);
  CHECK(shadowOf(scene, tests::sunAlongZ(4, -1, -21))[kMiddle] == 0.0F);
  CHECK(shadowOf(scene, tests::sunAlongZ(4, -1, -21, {true}))[kMiddle] == 1.0F);
}

TEST_CASE("a spot light does not see what is before its near plane", "[shadow]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, -0.5, 2);
  addWall(scene, -8, 2);
  const tyndall::Light light = tests::spotAtOrigin(1, 21);
  const double expected = tests::depthAt(host::fromMat4(light.shadow.views[0].clipFromWorld), {}, 8);
  CHECK(shadowOf(scene, light)[kMiddle] == Approx(expected).margin(3e-7));
}

TEST_CASE("each view has its layer; a single view fits a 2D texture", "[shadow]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, -4, 1);
  host::SceneRenderer renderer(scene);
  tyndall::Light light = tests::sunAlongZ(10, -1, -21);
  tyndall::ShadowView second = tests::sunAlongZ(1, 0, -40).shadow.views[0];
  second.layer = 1;
  light.shadow.views.push_back(second);
  const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, kSize);
  CHECK(host::readDepthArray(maps.depth.name(), kSize, kSize, 0)[kMiddle] == Approx(3.0 / 20));
  CHECK(host::readDepthArray(maps.depth.name(), kSize, kSize, 0)[0] == 1.0F);
  CHECK(host::readDepthArray(maps.depth.name(), kSize, kSize, 1)[0] == Approx(4.0 / 40));
  CHECK_THROWS_AS(renderer.renderShadowMap(restPose(scene), light, kSize, host::ShadowTarget::Single), host::Error);

  light.shadow.views.pop_back();
  const host::ShadowMapTextures single =
      renderer.renderShadowMap(restPose(scene), light, kSize, host::ShadowTarget::Single);
  CHECK(host::readDepth(single.depth.name(), kSize, kSize)[kMiddle] == Approx(3.0 / 20));
  single.attachTo(light);
  CHECK(light.shadow.texture == single.depth.name());
  CHECK(!light.shadow.array);
  CHECK(light.glass.colour == 0);
}

TEST_CASE("shadow maps refuse sizes and views that are not", "[shadow]") {
  tests::testContext();
  const host::Scene scene = tests::emptyScene();
  host::SceneRenderer renderer(scene);
  tyndall::Light light = tests::sunAlongZ(10, -1, -21);
  CHECK_THROWS_WITH(renderer.renderShadowMap({}, light, 0), Catch::Contains("shadow map size 0"));
  CHECK_THROWS_AS(renderer.renderShadowMap({}, light, 20000), host::Error);
  light.shadow.views[0].layer = 6;
  CHECK_THROWS_WITH(renderer.renderShadowMap({}, light, 4), Catch::Contains("shadow view layer 6"));
  light.shadow.views.clear();
  CHECK(!renderer.renderShadowMap({}, light, 4).depth);
}

TEST_CASE("masked and blended casters are cut out, glass and what is unlit cast no shadow", "[shadow]") {
  tests::testContext();
  const tyndall::Light light = tests::sunAlongZ(2, 0, -10);
  const std::size_t left = kSize / 2 * kSize + kSize / 4;
  const std::size_t right = kSize / 2 * kSize + 3 * kSize / 4;
  host::Material material;

  SECTION("masked") {
    host::Scene scene = tests::emptyScene();
    material.alphaMode = host::AlphaMode::Mask;
    material.texture = addHalfTexture(scene);
    addWall(scene, -5, 2, addMaterial(scene, material));
    const std::vector<float> depth = shadowOf(scene, light);
    CHECK(depth[left] == 1.0F);
    CHECK(depth[right] == Approx(0.5));
  }
  SECTION("blended: a shadow only where opaque") {
    host::Scene scene = tests::emptyScene();
    material.alphaMode = host::AlphaMode::Blend;
    addWall(scene, -5, 1, addMaterial(scene, material), {1, 0});
    material.baseColour.a = 0.6F;
    addWall(scene, -5, 1, addMaterial(scene, material), {-1, 0});
    const std::vector<float> depth = shadowOf(scene, light);
    CHECK(depth[left] == 1.0F);
    CHECK(depth[right] == Approx(0.5));
  }
  SECTION("unlit") {
    host::Scene scene = tests::emptyScene();
    material.unlit = true;
    addWall(scene, -5, 2, addMaterial(scene, material));
    CHECK(shadowOf(scene, light)[kMiddle] == 1.0F);
  }
  SECTION("glass") {
    host::Scene scene = tests::emptyScene();
    addWall(scene, -5, 2, addMaterial(scene, glassOf({1, 0, 0}, 1)));
    CHECK(shadowOf(scene, light)[kMiddle] == 1.0F);
  }
}

TEST_CASE("a blended surface lets 1 - alpha of the light through, texel by texel", "[shadow]") {
  tests::testContext();
  const tyndall::Light light = tests::sunAlongZ(2, 0, -10);
  const std::size_t left = kSize / 2 * kSize; // at the borders, where the texture is not interpolated
  const std::size_t right = left + kSize - 1;
  const auto tintOf = [&](const host::Scene& scene) {
    host::SceneRenderer renderer(scene);
    const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, kSize);
    REQUIRE(maps.glassColour);
    return host::readColourArray(maps.glassColour.name(), kSize, kSize, 0, 1);
  };
  host::Material material;
  material.alphaMode = host::AlphaMode::Blend;
  material.baseColour = {0.2F, 0.2F, 0.2F, 0.5F};

  SECTION("plain") {
    host::Scene scene = tests::emptyScene();
    addWall(scene, -5, 2, addMaterial(scene, material));
    CHECK(tintOf(scene)[kMiddle] == Approx(0.5).epsilon(1e-3));
  }
  SECTION("two, one after the other") {
    host::Scene scene = tests::emptyScene();
    addWall(scene, -5, 2, addMaterial(scene, material));
    addWall(scene, -6, 2, addMaterial(scene, material));
    CHECK(tintOf(scene)[kMiddle] == Approx(0.25).epsilon(1e-3));
  }
  SECTION("textured: alpha 0 on the left, 1 on the right") {
    host::Scene scene = tests::emptyScene();
    material.baseColour.a = 0.75F;
    material.texture = addHalfTexture(scene);
    addWall(scene, -5, 2, addMaterial(scene, material));
    CHECK(tintOf(scene)[left] == Approx(1).epsilon(1e-3));
    CHECK(tintOf(scene)[right] == Approx(0.25).epsilon(1e-3));
  }
  SECTION("with transmission: what it covers is glass") {
    host::Scene scene = tests::emptyScene();
    material.transmission = 1;
    addWall(scene, -5, 2, addMaterial(scene, material));
    CHECK(tintOf(scene)[kMiddle] == Approx(0.5 + 0.5 * 0.2).epsilon(1e-3));
  }
}

TEST_CASE("the glass map is the product of the panes before the first caster", "[shadow]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, -5, 1, addMaterial(scene, glassOf({0.5F, 1, 0.25F}, 1)));
  addWall(scene, -3, 2, addMaterial(scene, glassOf({1, 0.5F, 1}, 0.5F)));
  addWall(scene, -8, 2);
  addWall(scene, -9, 2, addMaterial(scene, glassOf({0, 0, 0.5F}, 1)));
  host::SceneRenderer renderer(scene);
  for (const ClipConvention convention : {ClipConvention{false}, ClipConvention{true}}) {
    INFO(tests::nameOf(convention));
    const tyndall::Light light = tests::sunAlongZ(4, 0, -10, convention);
    const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, kSize);
    const std::vector<float> colour = host::readColourArray(maps.glassColour.name(), kSize, kSize, 0, 3);
    const std::vector<float> glassDepth = host::readDepthArray(maps.glassDepth.name(), kSize, kSize, 0);
    const std::vector<float> depth = host::readDepthArray(maps.depth.name(), kSize, kSize, 0);
    const auto colourAt = [&](std::size_t texel) {
      return std::vector<float>{colour[3 * texel], colour[3 * texel + 1], colour[3 * texel + 2]};
    };
    const std::size_t outer = kSize / 2 * kSize + kSize / 4 + 1; // only the larger pane
    CHECK(colourAt(kMiddle) == std::vector<float>{0.25F, 0.25F, 0.125F});
    CHECK(colourAt(outer) == std::vector<float>{0.5F, 0.25F, 0.5F});
    CHECK(colourAt(0) == std::vector<float>{1, 1, 1});
    CHECK(glassDepth[kMiddle] == Approx(convention.reversed ? 0.7 : 0.3));
    CHECK(glassDepth[0] == (convention.reversed ? 0.0F : 1.0F));
    CHECK(depth[kMiddle] == Approx(convention.reversed ? 0.2 : 0.8));
  }
}
