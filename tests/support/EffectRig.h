// An effect in the test context, and frames whose textures a test fills with numbers.
#pragma once

#include "gl/Objects.h"
#include "reference/MapExact.h"
#include "support/TestContext.h"

#include <tyndall/tyndall.h>

namespace tests {

/// An effect of its own, for a test that requires it; without a loader in the configuration one of the test context.
std::unique_ptr<tyndall::Effect> newEffect(tyndall::Config config = {});

/// The effect of the test context, made when first asked for.
tyndall::Effect& testEffect();

/// A texture of floats: one channel (GL_R32F, depth formats), three or four by the format. Row 0 is the bottom row.
host::GlTexture floatTexture(GLenum internalFormat, int width, int height, const std::vector<float>& values);

/// The same as an array texture, layer by layer.
host::GlTexture floatTextureArray(GLenum internalFormat, int width, int height, int layers,
                                  const std::vector<float>& values);

/// A light's maps on the CPU and in GL: what the effect and the map-exact reference read.
struct ShadowRig {
  reference::ShadowImage image;
  host::GlTexture depth;
  host::GlTexture glassColour;
  host::GlTexture glassDepth;

  /// Uploads the image and enters the textures into the light. An array texture unless `array` is false.
  void upload(tyndall::Light& light, bool array = true, GLenum depthFormat = GL_DEPTH_COMPONENT32F);
};

/// A frame of given size: depth from numbers, outputs to float textures, a colour texture if wanted.
class FrameRig {
public:
  /// depth: window depth per pixel, row 0 at the bottom.
  FrameRig(int width, int height, const std::vector<float>& depth, GLenum depthFormat = GL_R32F);

  tyndall::Frame frame; ///< size, depth and outputs are filled in; the rest is the test's

  /// Renders and reads both outputs back; requires an Ok status.
  reference::ImageAnswer render();

  /// The map-exact reference of the same frame; shadows: one image per light, or none at all.
  reference::ImageAnswer reference(const std::vector<reference::ShadowImage>& shadows = {}) const;

  const std::vector<float>& depth() const { return depth_; }

private:
  std::vector<float> depth_;
  host::GlTexture depthTexture_;
  host::GlTexture inscatter_;
  host::GlTexture transmittance_;
};

/// A perspective projection with reversed depth and an infinite far plane, the most precise there is: depth = near / z.
/// For ClipDepth::ZeroToOne.
tyndall::Mat4 reversedInfinite(double verticalFov, double aspect, double near);

/// Viewed from eye towards target, y up (z up where the view is vertical).
tyndall::Mat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target);

tyndall::Mat4 toMat4(const glm::dmat4& m);

} // namespace tests
