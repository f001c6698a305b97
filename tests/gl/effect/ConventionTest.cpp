// Depth and camera conventions: one scene, the same picture whatever the projection, the depth's direction, range and
// format, the number of samples and the place in the world.
#include "SceneRig.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <cmath>
#include <map>

using namespace tyndall;
using host::gl;

namespace {

const std::vector<GLenum> kDepthFormats = {
    GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32, GL_DEPTH_COMPONENT32F, GL_R32F,
    GL_DEPTH24_STENCIL8,  GL_DEPTH32F_STENCIL8};

std::vector<tests::DepthConvention> allConventions() {
  std::vector<tests::DepthConvention> all;
  for (const bool orthographic : {false, true})
    for (const bool infinite : {false, true})
      for (const bool reversed : {false, true})
        for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne})
          if (!(orthographic && infinite)) all.push_back({reversed, infinite, orthographic, clipDepth, 0.5, 40});
  return all;
}

// How far the picture moves if every depth moves by one step of the format: what quantisation may cost.
double quantisation(GLenum format, const tests::DepthConvention& convention) {
  if (format == GL_DEPTH_COMPONENT16) return 1e-2;
  // float32 near 1 is as fine as 24 bits are; what is near 0 in reversed depth is finer.
  const bool isFloat = format == GL_R32F || format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH32F_STENCIL8;
  return isFloat && convention.reversed ? 2e-5 : 5e-5;
}

void checkAgainstReference(tests::SceneRig& rig, const reference::ImageAnswer& answer) {
  const reference::ImageAnswer truth = rig.reference();
  CHECK(tests::difference(answer.inscatter, truth.inscatter) <= 1e-4);
  CHECK(tests::difference(answer.transmittance, truth.transmittance) <= 1e-5);
}

} // namespace

TEST_CASE("every depth convention and format gives the same picture", "[sweep]") {
  for (const bool endlessSky : {false, true}) {
    std::map<bool, reference::ImageAnswer> expected; // by orthographic
    for (const tests::DepthConvention& convention : allConventions())
      for (const GLenum format : kDepthFormats) {
        if (endlessSky && format != GL_DEPTH_COMPONENT32F) continue;
        CAPTURE(convention.reversed, convention.infinite, convention.orthographic,
                static_cast<int>(convention.clipDepth), format, endlessSky);
        tests::SceneRig rig;
        rig.addLight(LightKind::Directional);
        rig.frame.medium.farDistance = endlessSky ? kInfinity : 25;
        rig.setConvention(convention, format);
        const reference::ImageAnswer answer = rig.render();
        checkAgainstReference(rig, answer);
        if (expected.count(convention.orthographic) == 0) {
          tests::DepthConvention exact = convention; // the quantisation-free picture of the same rays
          exact.reversed = true;
          rig.setConvention(exact);
          expected[convention.orthographic] = rig.reference();
        }
        const reference::ImageAnswer& wanted = expected[convention.orthographic];
        CHECK(tests::difference(answer.inscatter, wanted.inscatter) <= quantisation(format, convention));
        CHECK(tests::difference(answer.transmittance, wanted.transmittance) <= 0.1 * quantisation(format, convention));
      }
  }
}

TEST_CASE("point and spot lights agree in every depth convention") {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot}) {
    tests::SceneRig rig;
    rig.addLight(kind);
    for (const tests::DepthConvention& convention : allConventions()) {
      CAPTURE(static_cast<int>(kind), convention.reversed, convention.infinite, convention.orthographic,
              static_cast<int>(convention.clipDepth));
      rig.setConvention(convention);
      checkAgainstReference(rig, rig.render());
    }
  }
}

TEST_CASE("off-centre, mirrored and left-handed projections equal the reference") {
  tests::SceneRig rig;
  rig.addLight(LightKind::Directional);
  const Camera camera = rig.frame.camera;
  const auto check = [&](const char* name) {
    CAPTURE(name);
    checkAgainstReference(rig, rig.render());
  };
  rig.frame.camera.clipFromView[8] = 0.37; // a frustum off its axis, as a jitter or half of a stereo pair has it
  rig.frame.camera.clipFromView[9] = -0.21;
  check("off-centre");
  rig.frame.camera = camera;
  rig.frame.camera.clipFromView[5] *= -1; // top row first
  check("upside down");
  rig.frame.camera = camera;
  rig.frame.camera.clipFromView[0] *= -1;
  check("mirrored");
  rig.frame.camera = camera;
  for (std::size_t c = 0; c < 4; ++c) { // view space looks along +z
    rig.frame.camera.viewFromWorld[4 * c + 2] *= -1;
    rig.frame.camera.clipFromView[8 + c] *= -1;
  }
  check("left-handed");
  for (double& m : rig.frame.camera.clipFromView)
    m *= 1e-6; // a homogeneous factor means nothing
  check("scaled");
}

TEST_CASE("a shadow map's and the depth's compare mode and filters change nothing") {
  tests::SceneRig rig;
  const Light& light = rig.addLight(LightKind::Spot, tests::Casters::Blocks, true);
  rig.setConvention({}, GL_DEPTH_COMPONENT32F);
  const std::vector<std::pair<GLenum, GLuint>> textures = {{GL_TEXTURE_2D_ARRAY, light.shadow.texture},
                                                           {GL_TEXTURE_2D_ARRAY, light.glass.depth},
                                                           {GL_TEXTURE_2D_ARRAY, light.glass.colour},
                                                           {GL_TEXTURE_2D, rig.frame.depth.texture}};
  for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
    rig.frame.settings.shadowFilter = filter;
    const reference::ImageAnswer expected = rig.render();
    for (const bool odd : {true, false}) {
      for (const auto& [target, name] : textures) {
        const bool compared = odd && name != light.glass.colour;
        gl().BindTexture(target, name);
        gl().TexParameteri(target, GL_TEXTURE_COMPARE_MODE, compared ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
        gl().TexParameteri(target, GL_TEXTURE_MAG_FILTER, odd ? GL_LINEAR : GL_NEAREST);
        gl().TexParameteri(target, GL_TEXTURE_MIN_FILTER, odd ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
      }
      const reference::ImageAnswer answer = rig.render();
      CHECK(answer.inscatter == expected.inscatter);
      CHECK(answer.transmittance == expected.transmittance);
    }
    const reference::ErrorMetrics error = reference::compare(expected.inscatter, rig.reference().inscatter);
    INFO(error.text());
    CHECK(error.rRmse <= 1e-3);
    CHECK(error.p99 <= 5e-3);
  }
}

TEST_CASE("multisampled depth gives the mean over the samples", "[sweep]") {
  tests::SceneRig rig = tests::threeLights();
  rig.frame.medium.farDistance = 60;
  for (const GLenum format : {GL_DEPTH_COMPONENT32F, GL_R32F})
    for (const int wanted : {1, 2, 4}) {
      // Samples in no order, equal ones, sky among them.
      const auto depthOf = [&](int pixel, int sample) {
        const std::size_t other = static_cast<std::size_t>(pixel * 7 + sample * sample * 13) % rig.distances.size();
        return rig.convention().windowDepth(pixel % 3 == 0 ? 5 : rig.distances[other]);
      };
      const int samples = rig.setMultisampledDepth(wanted, format, depthOf);
      CAPTURE(format, wanted, samples);
      CHECK(samples >= wanted);
      const reference::ImageAnswer answer = rig.render();
      checkAgainstReference(rig, answer);
      reference::ImageAnswer mean = {reference::Image(24, 16), reference::Image(24, 16)};
      for (int sample = 0; sample < samples; ++sample) {
        std::vector<float> depth;
        for (int pixel = 0; pixel < 24 * 16; ++pixel)
          depth.push_back(depthOf(pixel, sample));
        rig.setDepth(depth);
        const reference::ImageAnswer one = rig.render();
        for (std::size_t i = 0; i < mean.inscatter.rgb.size(); ++i) {
          mean.inscatter.rgb[i] += one.inscatter.rgb[i] / samples;
          mean.transmittance.rgb[i] += one.transmittance.rgb[i] / samples;
        }
      }
      CHECK(tests::difference(answer.inscatter, mean.inscatter) <= 4e-6);
      CHECK(tests::difference(answer.transmittance, mean.transmittance) <= 1e-6);
    }
}

TEST_CASE("a scene far from the origin gives the same picture") {
  for (const bool orthographic : {false, true})
    for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
      CAPTURE(orthographic, static_cast<int>(kind));
      tests::SceneRig rig;
      Light& light = rig.addLight(kind);
      if (kind == LightKind::Directional) light.boundary = {true, {0, 3, 0}, {0.1, 1, 0}};
      tests::DepthConvention convention = rig.convention();
      convention.orthographic = orthographic;
      convention.infinite = !orthographic;
      rig.setConvention(convention);
      const reference::ImageAnswer expected = rig.render();
      tests::transformWorld(rig.frame, 1, {1e6, -2e6, 3e6});
      const reference::ImageAnswer answer = rig.render();
      CHECK(tests::difference(answer.inscatter, expected.inscatter) <= 1e-5);
      CHECK(tests::difference(answer.transmittance, expected.transmittance) <= 1e-6);
    }
}
