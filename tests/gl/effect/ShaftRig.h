// A scene of shafts in which camera, depth and shadow maps agree, and how far the fast techniques are from exact in it.
#pragma once

#include "SceneRig.h"

#include <functional>
#include <vector>

namespace tests {

/// Distance to the nearest of the scene's boxes, a floor, a ring of pillars and slats above them, along a ray with a
/// direction of any length, in units of that length; infinite if there is none. Nothing stands within 3 of (0, 2, 0).
double boxDistance(const glm::dvec3& origin, const glm::dvec3& direction);

/// A light that is not entered into a scene yet: a sun, or a lamp in front of an eye at (0, 2, 0) that looks along -z.
tyndall::Light shaftLight(tyndall::LightKind kind);

/// Errors of a technique against exact over some of the pixels, and what half a pixel of the picture (not for lamps,
/// whose brightness would move along) or half a texel of the shadow map changes there: a slice is up to half a pixel
/// away from the pixels that it serves, its row up to half a texel from their rays, so no less can be asked for.
struct ShaftError {
  double rRmse = 0;
  double displaced = 0;
};

/// Which pixels to compare.
using PixelSet = std::function<bool(int x, int y)>;

class ShaftRig {
public:
  /// An eye at (0, 2, 0) that looks along -z.
  explicit ShaftRig(int width = 96, int height = 64, RigContext context = RigContext::Test);

  SceneRig scene;

  /// Turns the camera: its view matrix and the depth that it sees.
  void look(const tyndall::Mat4& viewFromWorld);

  /// Enters the camera's projection, and the depth that it sees.
  void setConvention(const DepthConvention& convention);

  /// Puts cubes from -1 to 1, placed by these matrices, into the scene in place of those before: into depth and maps.
  void setMoving(const std::vector<glm::dmat4>& worldFromCube);

  /// Adds the light with maps of the boxes through `views` of its own, or through shadowViews() if there are none.
  tyndall::Light& addLight(const tyndall::Light& light, int mapSize = 128, bool glass = false);

  /// The picture of exact, and those that are half a pixel or texel off; rendered when first asked for.
  const reference::Image& truth();
  const std::vector<reference::Image>& displaced();

  /// Forgets the pictures of exact: the frame has changed.
  void changed();

  /// Renders with a technique and the settings of the frame.
  reference::Image picture(tyndall::Technique technique);

  /// Errors of a picture over some pixels, as parts of the mean of the truth over the same pixels or, where that is
  /// greater, over all of them.
  ShaftError error(const reference::Image& image, const PixelSet& where);
  ShaftError error(const reference::Image& image);

private:
  struct Maps {
    int size = 0;
    bool glass = false;
  };
  void seeBoxes();

  std::vector<glm::dmat4> moving_;
  std::vector<Maps> maps_;
  reference::Image truth_;
  std::vector<reference::Image> displaced_;
};

/// A small one, drawn by a technique, under a sun.
ShaftRig smallShaftRig(tyndall::Technique technique);

/// The views of a light around the scene: 1 (spot), 6 (point) or `cascades` (directional), the finest first.
std::vector<tyndall::ShadowView> shadowViews(const tyndall::Light& light, int cascades = 1);

/// Root mean square of the difference over some pixels, divided as ShaftRig::error says; infinite if a value is not
/// finite.
double errorWhere(const reference::Image& image, const reference::Image& truth, const PixelSet& where);

} // namespace tests
