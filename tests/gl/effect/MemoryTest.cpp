// Textures of the effect's own at 2560 x 1600 with a shadow map of 4096 x 4096 (half of what Yusov's needed).
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kWidth = 2560, kHeight = 1600, kMap = 4096;
constexpr double kMegabyte = 1024 * 1024;

std::uint64_t bytesOf(Profile profile, bool coloured) {
  tests::FrameRig rig(kWidth, kHeight, std::vector<float>(kWidth * kHeight, 0.01F), GL_DEPTH_COMPONENT24);
  Frame& frame = rig.frame;
  frame.camera.viewFromWorld = tests::lookAt({0, 1, 6}, {0.1, 0.4, 0});
  frame.camera.clipFromView = tests::reversedInfinite(0.9, 1.6, 0.05);
  frame.camera.clipDepth = ClipDepth::ZeroToOne;
  frame.medium.constituents = {{{0.1F, 0.1F, coloured ? 0.2F : 0.1F}, Phase::Isotropic, 0}};
  frame.settings = settingsOf(profile);
  Light light;
  light.direction = {0.4, -1, -0.3};
  const glm::dmat4 view = glm::lookAt(glm::dvec3(-8, 20, 6), glm::dvec3(0), glm::dvec3(0, 0, 1));
  light.shadow.views = {{tests::toMat4(glm::ortho(-9.0, 9.0, -9.0, 9.0, 1.0, 40.0) * view), 0}};
  const host::GlTexture map = host::makeTexture2D(GL_DEPTH_COMPONENT16, kMap, kMap);
  light.shadow.texture = map.name();
  frame.lights = {light};
  // Blended into the colour: outputs of the engine's own cost the effect nothing.
  const host::GlTexture colour = host::makeTexture2D(GL_R11F_G11F_B10F, kWidth, kHeight);
  frame.colour = colour.name();
  frame.output = {};
  const std::unique_ptr<Effect> created = tests::newEffect();
  const Status status = created->render(frame);
  INFO(status.message);
  REQUIRE(status);
  return created->statistics().bytes;
}

struct Case {
  Profile profile;
  double megabytes;
};

} // namespace

TEST_CASE("own textures stay small beside a large picture and shadow map", "[sweep]") {
  for (const Case& item : {Case{Profile::High, 44}, Case{Profile::Balanced, 22}, Case{Profile::Performance, 9}})
    for (const bool coloured : {false, true}) {
      CAPTURE(static_cast<int>(item.profile), coloured);
      const double megabytes = static_cast<double>(bytesOf(item.profile, coloured)) / kMegabyte;
      CHECK(megabytes <= item.megabytes);
    }
}
