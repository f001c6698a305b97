// A random frame as numbers: what it is does not depend on OpenGL.
#pragma once

#include "Axes.h"
#include "gl/effect/MapLayoutRig.h"

#include <optional>

namespace stress {

/// How the scene depth is stored.
enum class DepthForm { Float, Depth32F, Depth24, Depth16 };

/// By which change of a frame its picture must stay, or change in a known way.
enum class Relation {
  Scale,        ///< another unit of length
  Offset,       ///< moved within the world
  Mirror,       ///< left and right, of picture and world
  Roll,         ///< the camera turned by 90 degrees about its axis
  Depth,        ///< reversed clip depth, or the other one, in the same picture
  DoubledLight, ///< twice the radiance: twice the inscatter
  HalfMedia,    ///< each constituent as two of half its density
  LightOrder,   ///< the lights the other way round
  SplitLight,   ///< each light as two of half its radiance
};
inline constexpr int kRelations = static_cast<int>(Relation::SplitLight) + 1;
const char* nameOf(Relation relation);

struct Lens {
  tests::DepthConvention convention;
  double size = 0.5;   ///< tangent of half the vertical field of view; orthographic: half the height
  glm::dvec2 shift{0}; ///< of the image, in NDC
  tyndall::Mat4 clipFromView(double aspect) const;
};

struct LightMaps {
  reference::ShadowImage image;
  tests::Layout layout = tests::Layout::Array;
  GLenum format = GL_DEPTH_COMPONENT32F;
  bool isCompared = false; ///< GL_COMPARE_REF_TO_TEXTURE
  bool isOfFloats = false; ///< the views' matrices
  bool isNoise = false; ///< casters that change from texel to texel: what a row of a slice meets is a matter of chance
};

struct Case {
  std::uint64_t seed = 0;
  tyndall::Frame frame; ///< all but textures
  glm::ivec2 margin{0}; ///< texels around the viewport, on each side
  Lens lens;
  double worldScale = 1; ///< of the world's unit, which the frame's matrices have, and `lens` and `distances` have not
  std::vector<double> distances; ///< view distances, row 0 at the bottom; infinite: sky
  std::vector<float> depth;      ///< window depth of these; a few pixels may be odd
  std::vector<bool> isOdd;       ///< pixels whose depth is NaN, or no depth at all
  DepthForm depthForm = DepthForm::Float;
  std::vector<LightMaps> maps; ///< one a light
  bool hasOddTexels = false;   ///< NaN, infinite or outside [0, 1]
  glm::ivec3 lookup{0};        ///< texels and layers of a look-up; 0: none
  double lookupNear = 1, lookupFar = 2;
  reference::CurveMap eyeCurves; ///< of four nodes; without texels: none
  tyndall::Settings anySettings; ///< valid ones, for a picture that needs not be good
  Relation relation = Relation::DoubledLight;
};

/// The frame of a seed, with the axes of `simple` at their simplest.
Case makeCase(std::uint64_t seed, const AxisSet& simple);

/// In words, for whoever looks into a finding.
std::string describe(const Case& made); // Describe.cpp

// The parts of makeCase, in the order in which they are called.
void makePicture(Case& made, const AxisSet& simple);  // MakePicture.cpp: size, viewport, lens, pose, depth
void makeLights(Case& made, const AxisSet& simple);   // MakeLights.cpp: lights, places, cones, radiance
void makeMaps(Case& made, const AxisSet& simple);     // MakeMaps.cpp: views, texels, glass
void makeMedium(Case& made, const AxisSet& simple);   // Case.cpp
void makeSettings(Case& made, const AxisSet& simple); // Case.cpp

/// The frame that a relation makes of another, or none where the relation has no meaning for it.
std::optional<Case> related(const Case& made, Relation relation); // Related.cpp

/// The picture that `related` has, from the picture of the frame that it was made of.
reference::Image relatedPicture(const reference::Image& picture, Relation relation); // Related.cpp

/// The camera's frame in the world: columns right, up, back; and the eye.
struct EyeFrame {
  glm::dmat3 axes{1};
  glm::dvec3 position{0};
  explicit EyeFrame(const tyndall::Camera& camera);
  glm::dvec3 forward() const { return -axes[2]; }
};

/// A direction through some pixel of the picture, from the eye, unit length.
glm::dvec3 pixelDirection(const Case& made, Random& random);

tyndall::Vec3 toVec3(const glm::dvec3& v);

} // namespace stress
