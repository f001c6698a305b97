// A light's maps laid out as engines have them: in an array, an atlas, a cube map, in any encoding and format.
#pragma once

#include "ShaftRig.h"

namespace tests {

/// Texels of each layer.
enum class Layout {
  Array,    ///< a layer a view, as SceneRig has it
  Atlas,    ///< tiles of one GL_TEXTURE_2D
  Sheets,   ///< tiles of the layers of an array
  Cube,     ///< six faces
  CubeArray ///< the second cube of an array
};

/// A light's textures in another layout. What is in no tile, and in no layer of the light's, holds `poison`.
class LaidMaps {
public:
  LaidMaps(const reference::ShadowImage& image, Layout layout, float poison, GLenum depthFormat = GL_R32F);

  /// Enters the textures and where they hold what. Of a cube the views' matrices are left out: near and far imply them.
  void enter(tyndall::Light& light) const;

private:
  void lay(int views);
  host::GlTexture upload(GLenum internalFormat, int channels, const std::vector<float>& values, float poison) const;

  Layout layout_;
  int tileWidth_, tileHeight_, width_ = 0, height_ = 0, layers_ = 1;
  std::vector<tyndall::ShadowView> places_;
  host::GlTexture depth_, glassColour_, glassDepth_;
};

constexpr double kFaceNear = 0.25, kFaceFar = 50;

/// The six views around a light as everyone draws a cube map in GL: looked at, y downwards, 90 degrees.
std::vector<tyndall::ShadowView> faceViews(const tyndall::Light& light);

/// Of a texel's centre: distance along the view's axis, or from the light, for a window depth.
enum class Measure { Axial, Radial };
double distanceOf(const tyndall::Light& light, const tyndall::ShadowView& view, const glm::dvec2& ndc, double depth,
                  Measure measure);
/// The other way round.
double depthOf(const tyndall::Light& light, const tyndall::ShadowView& view, const glm::dvec2& ndc, double distance,
               Measure measure);

/// True if all of two pictures is the same.
bool identical(const reference::Image& a, const reference::Image& b);

/// Root mean square of the difference as a part of the mean.
double relativeError(const reference::Image& image, const reference::Image& truth);

/// A small scene of shafts with one light of a kind: a sun of three cascades, a lamp of the faces above, a spot.
std::unique_ptr<ShaftRig> layoutRig(tyndall::LightKind kind, bool glass, int mapSize = 48);

} // namespace tests
