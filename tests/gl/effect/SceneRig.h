// A small scene of shafts: depth, lights with maps, outputs, and its reference.
#pragma once

#include "support/EffectRig.h"

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace tests {

/// How a camera or a light maps distance to depth.
struct DepthConvention {
  bool reversed = false;
  bool infinite = false; ///< far plane at infinity; perspective only
  bool orthographic = false;
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
  double near = 0.5; ///< view distances
  double far = 40;

  /// size: tangent of half the vertical field of view, or half the height if orthographic.
  tyndall::Mat4 clipFromView(double size, double aspect) const;
  float windowDepth(double viewDistance) const; ///< infinite: the far value
};

/// What a light's maps hold.
enum class Casters { None, Blocks, AllLit, AllDark };

/// View distances of a wavy wall with some sky (infinite) in it, row 0 at the bottom.
std::vector<double> wallDistances(int width, int height);

/// Window depths as a light of that kind stores them, 1 without a caster: blocks, slopes and gaps.
std::vector<float> casterDepths(Casters casters, tyndall::LightKind kind, int size, int layers, unsigned seed = 7);

/// Where a rig's textures live.
enum class RigContext { Test, Current };

class SceneRig {
public:
  /// An eye at (0, 1, 6) that looks at the origin's surroundings, the wall behind, a medium, no light.
  explicit SceneRig(int width = 24, int height = 16, RigContext context = RigContext::Test);

  tyndall::Frame frame;
  std::vector<double> distances; ///< view distance per pixel that setConvention() turns into depth

  /// Enters the camera's projection and writes the depth of `distances`, in the given format.
  void setConvention(const DepthConvention& convention, GLenum format = GL_R32F);
  const DepthConvention& convention() const { return convention_; }

  /// Writes window depths, row 0 at the bottom.
  void setDepth(const std::vector<float>& depth, GLenum format = GL_R32F);

  /// Writes window depths, a pixel's samples side by side, into a multisampled texture. Returns the number of samples
  /// that the context gave, each of which takes values of its own from depthOf(pixel, sample).
  int setMultisampledDepth(int samples, GLenum format, const std::function<float(int, int)>& depthOf);

  /// A light above the scene, its shadow views around all that the camera sees.
  tyndall::Light& addLight(tyndall::LightKind kind, Casters casters = Casters::Blocks, bool glass = false);

  /// Replaces the maps of a light.
  void setShadow(std::size_t light, const reference::ShadowImage& image);
  const reference::ShadowImage& shadow(std::size_t light) const { return images_[light]; }

  /// A colour texture of the frame's size, entered into the frame. Values are RGBA.
  host::GlTexture makeColour(GLenum format, const std::vector<float>& rgba);

  /// Renders, with outputs, and reads them back; requires an Ok status.
  reference::ImageAnswer render(tyndall::Effect& effect);
  reference::ImageAnswer render() { return render(testEffect()); }

  /// Reads the outputs of the last render.
  reference::ImageAnswer outputs() const;

  /// Of each light, for the reference; the frame has their texture.
  std::vector<reference::CurveMap> curves;

  /// Of Frame::eyeCurves, likewise: the frame has its planes, too.
  reference::CurveMap eyeCurves;

  /// Of the frame's ambient light, for the reference; the frame has its texture.
  reference::Occlusion occlusion;

  /// The map-exact reference of the same frame.
  reference::ImageAnswer reference() const;

  const std::vector<float>& depth() const { return depth_; }

private:
  DepthConvention convention_;
  int samples_ = 1;
  std::vector<float> depth_;
  std::vector<reference::ShadowImage> images_;
  std::vector<ShadowRig> maps_;
  host::GlTexture depthTexture_, inscatter_, transmittance_;
};

/// A light's own shadow views as addLight() makes them, for the light's position and direction.
std::vector<tyndall::ShadowView> shadowViewsOf(const tyndall::Light& light);

/// A directional light with glass, a point and a spot light.
SceneRig threeLights();

/// Renders; all of both outputs must be finite and >= 0.
void checkFinite(SceneRig& rig);

/// Largest difference, relative to the expected value or to the mean of all of them, whichever is larger; infinite if a
/// value is not finite.
double difference(const reference::Image& image, const reference::Image& expected);

/// True if all values are finite and >= 0.
bool isFiniteAndNonNegative(const reference::Image& image);

/// True if all bits of two arrays are the same, those of NaNs too.
bool bitEqual(const std::vector<float>& a, const std::vector<float>& b);

/// An affine map of the world: scaled about the origin, then moved. The picture must stay.
void transformWorld(tyndall::Frame& frame, double scale, const glm::dvec3& offset);

} // namespace tests
