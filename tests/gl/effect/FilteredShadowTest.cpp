// The 2x2 filter in maps so coarse that the light changes within a texel: by a cone's soft edge, a lamp's nearness,
// extinction or the map's own scale. The picture equals the reference.
#include "AgainstReference.h"
#include "gl/effect/MapLayoutRig.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Through the filter, in maps of 3 x 3 blocks.
void checkBehindBlocks(tests::SceneRig& rig, double tolerance) {
  const Light& light = rig.frame.lights.front();
  rig.frame.settings.shadowFilter = ShadowFilter::Bilinear;
  reference::ShadowImage map;
  map.width = map.height = 3;
  map.layers = static_cast<int>(light.shadow.views.size());
  map.depth = tests::casterDepths(tests::Casters::Blocks, light.kind, 3, map.layers);
  rig.setShadow(0, map);
  rig.render();
  tests::checkAgainstReference(rig, tolerance);
}

} // namespace

TEST_CASE("filtered shadows of a lamp in a coarse map are exact in thick media, too") {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot})
    for (const float scattering : {0.05F, 2.0F, 10.0F}) {
      CAPTURE(static_cast<int>(kind), scattering);
      tests::SceneRig rig;
      Light& light = rig.addLight(kind);
      light.position = {0, 1.2, 4.5}; // a way of less than two optical depths, or of tens
      rig.frame.medium.constituents = {{{scattering, 0.3F * scattering, 0.01F}, Phase::HenyeyGreenstein, 0.6F}};
      checkBehindBlocks(rig, 5e-3);
    }
}

// The falloff rises and falls within a texel, and what is lit may lie many optical depths away.
TEST_CASE("filtered shadows of a spot in a coarse map follow its soft edge, also behind optical depths that are dark") {
  for (const auto& [outer, inner] : {std::pair{0.03, 0.0}, {0.1, 0.0}, {0.7, 0.0}, {0.7, 0.6}})
    for (const float scattering : {0.01F, 3.0F})
      for (const double away : {0.0, 1e-6, 0.3}) {
        CAPTURE(scattering, outer, inner, away);
        tests::SceneRig rig;
        Light& light = rig.addLight(LightKind::Spot);
        const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld));
        light.position = toVec3(glm::dvec3(worldFromView * glm::dvec4(4.9, -3, -5, 1)));
        light.direction = toVec3(glm::dvec3(worldFromView * glm::dvec4(-4.9, 3, away, 0)));
        light.outerConeAngle = static_cast<float>(outer);
        light.innerConeAngle = static_cast<float>(inner);
        rig.frame.medium.constituents = {{{scattering, 0.3F * scattering, 0.01F}, Phase::HenyeyGreenstein, 0.6F}};
        const glm::dvec3 position = reference::toVec3(light.position), direction = reference::toVec3(light.direction);
        light.shadow.views = {{tests::toMat4(glm::perspective(2.2 * outer, 1.0, 0.1, 60.0) *
                                             glm::lookAt(position, position + direction, glm::dvec3(0.1, 1, 0.2))),
                               0}};
        checkBehindBlocks(rig, 5e-3);
      }
}

// Texels of a view of nearly half of all directions: along a ray most of one is passed within a hundredth of the way.
TEST_CASE("filtered shadows of a spot that is nearly a half space leave what they should behind a dark centre") {
  for (const double side : {0.1, 0.5, 2.0}) {
    CAPTURE(side);
    tests::SceneRig rig;
    Light& light = rig.addLight(LightKind::Spot);
    const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld));
    light.position = toVec3(glm::dvec3(worldFromView * glm::dvec4(side, -1.2 * side, -2, 1)));
    light.direction = toVec3(glm::dvec3(worldFromView * glm::dvec4(-side, 1.2 * side, 2, 0)));
    light.innerConeAngle = light.outerConeAngle = 1.569F;
    rig.frame.settings.shadowFilter = ShadowFilter::Bilinear;
    const glm::dvec3 position = reference::toVec3(light.position), direction = reference::toVec3(light.direction);
    light.shadow.views = {{tests::toMat4(glm::perspective(3.12, 1.0, 0.01, 60.0) *
                                         glm::lookAt(position, position + direction, glm::dvec3(0.1, 1, 0.2))),
                           0}};
    reference::ShadowImage map;
    map.width = map.height = 3;
    map.layers = 1;
    map.depth = {1, 1, 1, 1, 0, 1, 1, 1, 1};
    rig.setShadow(0, map);
    rig.render();
    tests::checkAgainstReference(rig, 5e-3);
  }
}

// See stress.loops.dark-channel, too.
TEST_CASE("filtered shadows of a lamp far behind the eye reach to where the clearest channel ends") {
  for (const double behind : {3.0, 6e4}) {
    CAPTURE(behind);
    tests::SceneRig rig;
    for (double& distance : rig.distances)
      distance = kInfinity;
    rig.setConvention(tests::DepthConvention{});
    Light& light = rig.addLight(LightKind::Point);
    const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld));
    light.position = toVec3(glm::dvec3(worldFromView * glm::dvec4(0.02, 0.05, behind, 1)));
    light.shadow.views = tests::faceViews(light);
    rig.frame.medium.constituents = {{{3e-9F, 4e-5F, 1.7e-7F}, Phase::HenyeyGreenstein, 0.6F}};
    rig.frame.medium.absorption = {0.022F, 1e-7F, 0};
    rig.frame.medium.farDistance = kInfinity;
    rig.frame.settings.shadowFilter = ShadowFilter::Bilinear;
    reference::ShadowImage map;
    map.width = map.height = 4;
    map.layers = 6;
    for (int i = 0; i < 4 * 4 * 6; ++i)
      map.depth.push_back((i ^ (i >> 2)) % 2 ? 0.0F : 1.0F);
    rig.setShadow(0, map);
    rig.render();
    tests::checkAgainstReference(rig, 5e-3);
  }
}

// One channel is gone within a texel's first hundredth, another sees all of it.
TEST_CASE("filtered shadows of a sun in a coarse map are exact in every channel of a coloured medium") {
  // A boundary's share of the light's direction in its normal: across the light, or so much along it that light grows
  // along rays.
  for (const auto& [scattering, share] :
       {std::pair{0.5F, 0.0}, {50.0F, 0.0}, {5000.0F, 0.0}, {0.5F, 0.05}, {3.0F, -0.05}, {0.5F, 0.3}}) {
    CAPTURE(scattering, share);
    tests::SceneRig rig;
    Light& light = rig.addLight(LightKind::Directional);
    if (share != 0) {
      const glm::dvec3 along = glm::normalize(reference::toVec3(light.direction));
      const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0.3, 0.2, 1)));
      const glm::dvec3 eye(glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld))[3]);
      light.boundary = {true, toVec3(eye + 2.0 * across), toVec3(across + share * along)};
    }
    rig.frame.medium.constituents = {{{scattering, 0.3F, 0.01F}, Phase::HenyeyGreenstein, 0.6F}};
    checkBehindBlocks(rig, 5e-3);
  }
}

// The same through layers. Steps were as short as the fastest channel asks for, also where nothing was left of it, and
// ran out in the first texel.
TEST_CASE("filtered shadows through layers are exact in every channel, however thick another is") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const float scattering : {0.5F, 50.0F, 5000.0F}) {
      CAPTURE(static_cast<int>(kind), scattering);
      tests::SceneRig rig;
      rig.addLight(kind);
      Medium& medium = rig.frame.medium;
      medium.constituents = {{{scattering, 0.3F, 0.01F}, Phase::HenyeyGreenstein, 0.6F},
                             {{0.01F, 0.02F, 0.03F}, Phase::Rayleigh}};
      medium.constituents[0].layer = 0;
      medium.layers = {{0.5, 3}};
      checkBehindBlocks(rig, 2e-3);
    }
}
