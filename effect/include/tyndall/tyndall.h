// Tyndall: volumetric shadows and light shafts as an OpenGL post-process effect.
//
// This header is the whole public interface but for smoke and hair (tyndall/avsm.h) and Earth's air
// (tyndall/atmosphere.h). An engine creates one Effect per GL context, describes a frame and calls
// render() once; the effect adds single-scattered light with volumetric shadows to the engine's colour texture.
//
//     out(v) = back(v) T(d) + sum over lights of  integral_0^d T(s) C(s) [sum_k sigma_k p_k] E V G A ds
//                           + integral_0^d T(s) C(s) [sum_k sigma_k  integral p_k L_ambient] ds  (Ambient),
//                           + the same with -dC/ds a p in place of C(s) [sum_k ...], fog of albedo a  (EyeCurves),
//     T(s) = exp(-integral_0^s sigma_t), A and C what smoke leaves of light on its way there and to the eye.
//
// Conventions. World units are the engine's own: nothing depends on their scale. Matrices are column-major, column
// vectors, destinationFromSource. Colours are linear RGB. Angles are radians. Texture row 0 is the bottom row, y = -1
// in clip space, whatever glClipControl says while the effect runs: maps that were drawn with GL_UPPER_LEFT come with
// matrices whose row y is negated. No function throws. All functions of an Effect, its destructor too, need the GL
// context current that create() saw.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace tyndall {

using Vec3 = std::array<double, 3>;  ///< a position or direction in world space
using Rgb = std::array<float, 3>;    ///< one value per colour channel, linear
using Mat4 = std::array<double, 16>; ///< column-major: element (row r, column c) at [4 c + r]

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Mat4 kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline constexpr int kMaxConstituents = 4;  ///< scattering constituents of a medium
inline constexpr int kMaxHeightLayers = 2;  ///< its layers that thin out with height
inline constexpr int kMaxShadowViews = 6;   ///< shadow views of a light: cascades or cube faces
inline constexpr int kMaxLights = 16;       ///< lights of a frame
inline constexpr int kMaxImageSize = 16384; ///< pixels per side of every texture

/// Copies a column-major matrix, as GLM and most engines store them.
Mat4 mat4(const float* columnMajor);
Mat4 mat4(const double* columnMajor);
/// Copies a row-major matrix for column vectors: element (row r, column c) at [4 r + c], as OGRE stores them.
Mat4 mat4RowMajor(const float* rowMajor);
Mat4 mat4RowMajor(const double* rowMajor);
/// Copies a glm::mat4 or glm::dmat4, or what is like them: matrix[column][row].
template <typename Matrix, typename = typename Matrix::col_type>
Mat4 mat4(const Matrix& matrix) {
  Mat4 copy{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      copy[static_cast<std::size_t>(4 * column + row)] = static_cast<double>(matrix[column][row]);
  return copy;
}

/// Copies whatever has members x, y and z: glm::vec3, Ogre::Vector3.
template <typename Vector>
Vec3 vec3(const Vector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
template <typename Vector>
Rgb rgb(const Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// ---------------------------------------------------------------------------------------------------------------------
// Results

enum class StatusCode {
  Ok,
  NoContext,     ///< no GL context is current, or another than the one the effect was created in
  ContextTooOld, ///< the context lacks OpenGL 3.3 and OpenGL ES 3.2, or a function or an extension that is needed
  ShaderError,   ///< a shader did not compile or link: a defect of Tyndall or of the driver
  OutOfMemory,   ///< GL could not allocate a texture or buffer
  InvalidConfig, ///< a field of Config breaks its rule
  InvalidFrame,  ///< a field of Frame breaks its rule
  ContextLost,   ///< the GPU was reset: what GL held is gone; a new context is needed, and all objects anew
  Abandoned,     ///< Config::betweenDraws did not want the rest of the frame
};

/// The outcome of a call. The message is one line that names field, value and rule; for ShaderError the log follows.
struct Status {
  StatusCode code = StatusCode::Ok;
  std::string message;
  explicit operator bool() const { return code == StatusCode::Ok; }
};

// ---------------------------------------------------------------------------------------------------------------------
// What a frame consists of

/// How clip-space z maps to the depth buffer: glClipControl's GL_NEGATIVE_ONE_TO_ONE (default) or GL_ZERO_TO_ONE.
enum class ClipDepth { NegativeOneToOne, ZeroToOne };

/// A part of a texture: texels, from column x and row y on.
struct Rectangle {
  int x = 0, y = 0;
  int width = 0, height = 0;
};

/// What the values of a depth texture mean. All but Window: of a perspective view a distance from the eye or the light,
/// of an orthographic one from its near plane.
enum class DepthEncoding {
  Window,      ///< what the projection, and glDepthRange (0, 1), leave in a depth buffer
  Axial,       ///< DepthScale::offset + DepthScale::unit x value is the distance along the view's axis
  Radial,      ///< the same is the distance itself; perspective views only
  Logarithmic, ///< value = log(1 + constant w) / log(1 + constant farDistance), w the distance along the axis;
               ///< perspective
};

/// The measure of a DepthEncoding.
struct DepthScale {
  double unit = 1;   ///< Axial, Radial: world units of a value of 1, not 0: 1 for world units, the far plane's distance
                     ///< for a map from 0 to 1, whose value 1 is then sky wherever the far plane is
  double offset = 0; ///< Axial, Radial: world units of a value of 0
  double constant = 1;    ///< Logarithmic: 1/world unit, > 0
  double farDistance = 0; ///< Logarithmic: distance at which the value is 1, world units, > 0
};

/// The camera that rendered colour and depth. Perspective and orthographic projections, standard and reversed depth
/// and an infinite far plane are read off the matrix. glDepthRange is taken to be (0, 1).
struct Camera {
  Mat4 viewFromWorld = kIdentity; ///< invertible, affine
  Mat4 clipFromView = kIdentity;  ///< invertible (an infinite far plane is)
  ClipDepth clipDepth = ClipDepth::NegativeOneToOne;
  /// By how many pixels clipFromView moves the image, for temporal antialiasing: to the right and up; |x|, |y| <= 16.
  /// What is sampled along slices is sampled as without it, so that it neither flickers nor ends a reuse; one of up to
  /// half a pixel after one of more does. With Frame::reuse an eye whose jitter comes to rest at 0 keeps the slices of
  /// a jittered one, which go half a pixel beyond the image, until its camera moves.
  std::array<double, 2> jitter = {0, 0};
};

/// The engine's depth buffer. Depth at the far value is sky, and where the encoding has none what lies at the far plane
/// or beyond; a pixel whose depth is NaN is left as it is.
struct SceneDepth {
  std::uint32_t texture = 0; ///< GL_TEXTURE_2D, _2D_ARRAY, _2D_MULTISAMPLE or _2D_MULTISAMPLE_ARRAY, a depth format or
                             ///< R32F, level 0
  bool multisampled = false; ///< true for the multisampled; inscatter is then the mean over a pixel's samples
  std::uint64_t version =
      0; ///< of what this texture holds, for Frame::reuse: any number that differs says it changed; 0: not known
  int layer = -1; ///< of an array; -1: it is none
  /// Texels that show the frame's viewport. All 0: those of the viewport, in a texture as large as colour and outputs.
  /// Pixel (i, j) of the viewport has the depth of texel x + floor((i + 0.5) width / viewport.width), and so in y.
  Rectangle rectangle = {};
  DepthEncoding encoding = DepthEncoding::Window; ///< R16F and RG32F, too, where it is another
  DepthScale scale = {};
};

enum class LightKind { Directional, Point, Spot };

/// One projection of a shadow map. It owns the part of a camera ray inside its side planes, from its near plane on.
/// Light that enters through the near plane is unblocked. What lies beyond the far plane is judged by what the map
/// holds (for cascades only in the last view; elsewhere it falls to the next cascade). A point in several views belongs
/// to the first of them; a point in none is lit or dark by Light::litOutsideViews. What lies beyond a side by no more
/// than float rounding, about 1e-6 of the distances to the light and to the eye, is inside: so a spot's view may be
/// exactly as wide as its cone, and views may share a side, as the faces of a cube do, also with matrices of floats.
struct ShadowView {
  Mat4 clipFromWorld = kIdentity; ///< invertible; standard or reversed depth is read off the matrix
  int layer = 0;                  ///< array layer, 0 for a GL_TEXTURE_2D
  Rectangle rectangle = {}; ///< texels of the layer that show the view, an atlas's tile, say; all 0: the whole layer
};

/// The six views of a cube map: those that GL's faces have, around Light::position, with GL's order and orientation
/// (GL_TEXTURE_CUBE_MAP_POSITIVE_X first), each drawn with a field of view of 90 degrees and y downwards, as a cube map
/// is sampled.
struct CubeMap {
  bool enabled = false; ///< the texture is a GL_TEXTURE_CUBE_MAP, or with ShadowMap::array a GL_TEXTURE_CUBE_MAP_ARRAY
  int index = 0;        ///< which cube of an array
  double nearDistance = 0;    ///< of the faces' near plane, world units, > 0
  double farDistance = 0;     ///< of their far plane, > nearDistance, may be infinite
  bool reversedDepth = false; ///< DepthEncoding::Window: 1 at the near plane and 0 at the far plane
};

/// A light's shadow map: depth as seen from the light, compare mode on or off. A texel at or beyond the far value, or
/// NaN, blocks nothing; one that is nearer than the near plane blocks everything behind that.
struct ShadowMap {
  std::uint32_t texture = 0; ///< GL_TEXTURE_2D, _2D_ARRAY, _CUBE_MAP or _CUBE_MAP_ARRAY; a depth format, R16F, R32F or
                             ///< RG32F, whose first channel is read; 0: nothing blocks the light
  bool array = false;        ///< true for GL_TEXTURE_2D_ARRAY and GL_TEXTURE_CUBE_MAP_ARRAY
  ClipDepth clipDepth = ClipDepth::NegativeOneToOne;
  std::vector<ShadowView>
      views; ///< 1 to 6: 1-4 cascades (finest first) for a directional light, 1 for a spot, 6 for a point
  std::uint64_t version = 0; ///< of what these textures, the glass map's too, hold, as SceneDepth::version
  DepthEncoding encoding = DepthEncoding::Window; ///< not Logarithmic
  DepthScale scale = {};
  CubeMap cube = {}; ///< in place of views
};

/// Stained glass seen from the light through the same views as the shadow map. Light is tinted behind the glass.
struct GlassMap {
  std::uint32_t colour = 0; ///< RGB(A) transmittance in [0, 1], beyond that clamped, NaN as 0; 1 where there is no
                            ///< glass. Same target as the shadow map. 0: no glass
  std::uint32_t depth =
      0; ///< depth of the glass nearest to the light, same size, layers and convention as the shadow map; NaN: no glass
};

/// Transmittance of smoke and hair from the light on, as Avsm::curves() gives it (tyndall/avsm.h), through the same
/// views as the shadow map: those of view i were captured into layer i, whatever its layer in the shadow map.
struct AvsmCurves {
  std::uint32_t texture = 0; ///< GL_TEXTURE_2D_ARRAY, RGBA32UI; 0: nothing dims the light
  int nodes = 8;             ///< of a curve
  bool packed = true;
  std::uint64_t version = 0; ///< of what the texture holds, as SceneDepth::version
};

/// The plane where the medium begins, for a directional light: light is attenuated from there on.
struct MediumBoundary {
  bool enabled = false;
  Vec3 point = {0, 0, 0};
  Vec3 normal = {0, 1, 0}; ///< any length; the light must not travel parallel to the plane
};

struct Light {
  LightKind kind = LightKind::Directional;
  Vec3 direction = {0, -1, 0}; ///< directional, spot: where the light travels to; any length but 0
  Vec3 position = {0, 0, 0};   ///< point, spot
  Rgb colour = {1, 1, 1}; ///< directional: irradiance on a plane facing the light; point, spot: radiant intensity; >= 0
  double range = kInfinity;  ///< point, spot: no light beyond; > 0
  double innerConeAngle = 0; ///< spot: full intensity up to this half angle, 0 <= inner <= outer
  double outerConeAngle =
      0.7853981633974483; ///< spot: none beyond this half angle, 0 < outer <= pi/2. glTF's KHR_lights_punctual falloff
  float scatteringScale = 1;   ///< all but 1 is unphysical: times what the medium scatters of it; finite and >= 0
  bool litOutsideViews = true; ///< visibility where no shadow view reaches
  /// Directional: share of a cascade's width, at each of its sides and at its far plane, over which it fades into the
  /// next one that reaches there; the last one does not fade. 0 to 0.5. 0: a seam
  double cascadeFade = 0;
  MediumBoundary boundary; ///< directional
  ShadowMap shadow;
  GlassMap glass;
  AvsmCurves curves;
};

/// Phase functions, normalised to 1 over the sphere, in 1/sr. theta is the angle between the light's travel direction
/// and the direction to the eye: forward scattering (g > 0) brightens the view towards the light.
enum class Phase {
  Isotropic,        ///< 1 / (4 pi)
  Rayleigh,         ///< 3 / (16 pi) (1 + cos^2 theta)
  HenyeyGreenstein, ///< 1 / (4 pi) (1 - g^2) / (1 + g^2 - 2 g cos theta)^(3/2)
  CornetteShanks,   ///< 3 / (8 pi) (1 - g^2) / (2 + g^2) (1 + cos^2 theta) / (1 + g^2 - 2 g cos theta)^(3/2)
};

struct Constituent {
  Rgb scattering = {0, 0, 0}; ///< scattering coefficient, 1/world unit, finite and >= 0
  Phase phase = Phase::Isotropic;
  float g = 0;    ///< asymmetry of HenyeyGreenstein and CornetteShanks, -1 < g < 1
  int layer = -1; ///< of Medium::layers, whose density scattering is to be multiplied by; -1: it is the same everywhere
};

/// Density that thins out with height, as fog's, haze's and the air's does: exp(-(h - height) / scale) at the height
/// h = dot(up, x), up the unit vector along Medium::up; below the ground what it is at the ground. It is at most e^60,
/// about 1e26.
struct HeightLayer {
  double height = 0;          ///< where density is 1: coefficients are those here; world units, finite
  double scale = kInfinity;   ///< over so much height density falls to 1/e; world units, > 0; infinite: 1 everywhere
  double ground = -kInfinity; ///< world units, not NaN, < infinity
};

/// A medium that fills all space; Earth's air is one of airOf()'s (tyndall/atmosphere.h). Extinction is the sum of all
/// scattering and the absorption.
struct Medium {
  std::vector<Constituent> constituents; ///< at most 4
  Rgb absorption = {0, 0, 0};            ///< 1/world unit, finite and >= 0
  double farDistance = kInfinity;        ///< where rays to the sky end, world units, > 0
  int absorptionLayer = -1;              ///< of layers, as Constituent::layer
  std::vector<HeightLayer> layers = {};  ///< at most 2
  Vec3 up = {0, 1, 0};                   ///< any length but 0
  bool dimsBackground = true; ///< false is unphysical: the medium adds its light and dims nothing behind it, T(d) = 1;
                              ///< its own light it dims as ever
};

/// What stands between a pixel's stretch of medium and the surroundings: the share of their radiance that it gets.
struct AmbientOcclusion {
  std::uint32_t texture = 0; ///< GL_TEXTURE_2D, R8, R16, R16F or R32F, level 0, of any size: all of it shows the
                             ///< frame's viewport, bilinear. 0 to 1, beyond that clamped, NaN as 1. 0: nothing
  std::uint64_t version = 0; ///< of what it holds, as SceneDepth::version: with Frame::reuse all pixels are drawn anew
                             ///< unless it is as in the eye's last frame, and not 0
};

/// Light of the surroundings, as of a sky: it comes from all sides at once, and each constituent scatters it by its
/// phase function. It is the radiance at every place of the medium: no shadow map blocks it, and what the medium takes
/// on its way there is left out of it already. The closed form is that of a directional light without shadows.
struct Ambient {
  Rgb radiance = {0, 0, 0}; ///< from every side; finite and >= 0
  /// Radiance besides, by the side that it comes from: the coefficients of nine real spherical harmonics, in the order
  /// and with the factors of Ramamoorthi and Hanrahan 2001: for a unit vector in world space that points to where light
  /// comes from, 0.282095, 0.488603 (y, z, x), 1.092548 (x y, y z), 0.315392 (3 z^2 - 1), 1.092548 x z,
  /// 0.546274 (x^2 - y^2). Finite. Where the constituents that follow one layer, or none, would scatter less than
  /// nothing towards the eye together, they scatter nothing.
  std::array<Rgb, 9> harmonics = {};
  AmbientOcclusion occlusion;
};

/// All but Exact need shadow views whose centre is the light itself, its direction or its position, and refuse others,
/// of which Exact warns.
enum class Technique {
  Exact,    ///< every shadow texel along every pixel's ray, closed form or quadrature per lit span: the reference
  Tree,     ///< every pixel along its nearest slice's row, skipping by a min/max tree (Chen 2011)
  Epipolar, ///< march samples along epipolar slices, interpolated and unwarped (Yusov 2013)
  LowRank,  ///< as Tree, lit spans integrated by a low-rank approximation of the airlight (Chen 2011): for fine glass,
            ///< and to compare
};

enum class ShadowFilter {
  Nearest,  ///< a shadow texel is a flat step; where the ray crosses its depth is solved for, not sampled
  Bilinear, ///< 2x2 percentage-closer filtering, integrated along the ray
};

/// Quality against time. The profiles are rows of one table; each knob may be set by itself as well.
enum class Profile { Performance, Balanced, High, Reference };

/// Debug views: pictures of what the effect did. All but Composite replace the RGB of Frame::colour, which must be
/// given; outputs are written as ever. Colours are linear, mostly in [0, 1]. Views of slices and samples show the first
/// light that is drawn, and black where none is. They need the technique that is said.
enum class DebugView {
  Composite, ///< the normal picture
  Slices,  ///< Tree, Epipolar, LowRank: each pixel's nearest slice: a hue for 16 of them, every second one darker; the
           ///< light's own place in the image white. With an errorTarget the hue says how far they are apart: red where
           ///< all are drawn that there may be, yellow, green, blue where every second, fourth, eighth is
  Samples, ///< Epipolar: samples in each pixel: red counts them, green their quarter, blue their sixteenth
  Breaks,  ///< Epipolar: samples on the near side of a depth break in red, on the far side in blue
  MarchSamples, ///< Epipolar: march samples in each pixel: blue counts the regular ones, red those that breaks, slice
                ///< ends and the light's vicinity ask for, green those where the inscatter bends
  FixupPixels,  ///< Epipolar: pixels that no sample served or, with a spreadThreshold, whose samples differ, red
  NodeVisits, ///< Tree, Epipolar, LowRank: nodes and groups of texels that a ray through the pixel's slice looks at, in
              ///< all views. Black 0 over blue, red, yellow to white 1023, by log2(1 + n); ticks of the bar at each
              ///< factor of 4. Epipolar marches only some pixels: MarchSamples shows where
  Inscatter,  ///< radiance that all lights add
  Transmittance, ///< T(d)
  Difference,    ///< the technique's inscatter less exact's, which is rendered too: mean over R, G, B, as a part of the
                 ///< mean of exact over the image. Grey 0, red up to +10 %, blue down to -10 %; ticks every 5 %
  Redrawn,       ///< Frame::reuse: pixels that this frame drew anew red, the others black; without reuse all are red
  Inputs, ///< what the effect was given, to find mistakes: depth as distance, darker up to a white line each time that
          ///< it doubles; in the hue of the first light's shadow view that a surface lies in, grey outside all; dark
          ///< where the map shadows it, magenta where its surface lies far in front of the map's, which few right
          ///< pairs show, orange where the map has none; no distance (NaN) red, sky nearly black. Any technique
};

struct Settings {
  Technique technique = Technique::Epipolar;
  DebugView debugView = DebugView::Composite;
  ShadowFilter shadowFilter = ShadowFilter::Nearest;
  int slices = 1152; ///< all but Exact: epipolar lines, 1 to 8192; never more than pixels on the visible border
  int samples = 512; ///< Epipolar: samples of a slice, a multiple of 64 from 64 to 8192; never denser than pixels
  int rowStep = 1;   ///< all but Exact: shadow-map texels from one sample of a row to the next, 1 to 8
  bool minMaxTree =
      true; ///< all but Exact: skip along rows by their min/max tree; off: texel by texel, for measurements
  float breakThreshold = 0.04F; ///< Epipolar: relative change of distance that counts as a depth break, > 0; an
                                ///< eighth of it, from a straight line, as a crease
  float bendThreshold =
      0.02F; ///< Epipolar: relative bend of the inscatter along a slice that is marched more finely, > 0
  float leastWeight = 0.01F; ///< Epipolar: bilateral weight under which a pixel is marched by itself, 0 to 1
  /// All but Exact: optical depth (for lamps also length over distance to the lamp) of a stretch that may be taken as
  /// a whole where a ray passes lit and dark texels between two layers of casters, by the share of lit ones and its
  /// first moment; 0 to 1. 0: never
  float averageThreshold = 0.1F;
  /// Epipolar: standard deviation of the inscatter of the samples that serve a pixel, as a part of the picture's mean,
  /// over which it is marched along its own line through the shadow map, as exactly as by Technique::Exact; > 0. 0.01
  /// to 0.05 bring thin shafts that run between two slices, at several times the cost; no profile asks for it. Pixels
  /// of a multisampled depth whose samples show several surfaces are left out: they take what the slices have.
  float spreadThreshold = std::numeric_limits<float>::infinity();
  /// Epipolar: root mean square error of a light's inscatter, as a part of its mean, up to which slices and march
  /// samples are left out: 0 to 1, 0.01 is a hundredth; 0: none is. A coarser look at the light, by an eighth of twice
  /// as many as `slices`, tells where they are close to what those beside them lead to expect. As many are drawn as the
  /// target takes, no more than `slices` in all, where they take most off the error of the whole image: by places from
  /// a quarter as near to each other as without a target to twice as near. Where that does not reach it the error is
  /// greater; Statistics::errorEstimate says how great it is expected to be. Shafts that are thinner than that look's
  /// slices are apart, 8 pixels at least at the border, 14 by Profile::High at 1280 x 720, may be missed where they lie
  /// between. With a finite spreadThreshold, with Frame::reuse, and of fewer than 32 slices all are drawn, whatever the
  /// target.
  float errorTarget = 0;
  /// LowRank: terms of the approximation, 1 to 8. Its error grows with the optical depth and with how much a lamp's
  /// phase function is peaked. Where the airlight has more than two coordinates (an orthographic camera before a lamp,
  /// a light with a boundary) LowRank is Tree.
  /// With a far plane at infinity it counts on rays that end at Medium::farDistance.
  int lowRankTerms = 4;
  /// Epipolar: slices x samples of all lights together, dealt out by how much of the image a light covers and how
  /// bright it is; 0, or from 4096 on. A light gets at least 4096 and at most its own slices x samples, which 0 gives
  /// to every light.
  int sampleBudget = 0;
};

/// The settings of a profile. Reference is Technique::Exact.
Settings settingsOf(Profile profile);

/// How a frame says what changed in the depth buffer and in the shadow and glass maps since its eye's last frame: an
/// eye is a camera of the engine's with the frames that it has shown.
enum class Changes {
  Unknown, ///< anything may have: the frame is drawn in full, and nothing is kept of the eye
  Detect,  ///< the effect compares them with the last frame's, but for those whose versions say that nothing changed
  Objects, ///< only what Frame::objects names, around which they are compared; their versions are not looked at
};

/// Temporal reuse (Lin et al. 2013): light of the last frame is kept where nothing has changed. A frame that reuses is
/// what it would be in full, to rounding. Camera, medium, settings, lights and sizes are compared by the effect: what a
/// change of them touches is drawn anew. Only Technique::Epipolar redraws parts of a picture; by the other techniques
/// or with a finite Settings::spreadThreshold any change redraws all of it, as any debug view but Redrawn does; with a
/// multisampled depth any redraws all pixels, but not all slices. A light whose shadow views are too large to be
/// marched at once is redrawn whole. Where only Camera::jitter changes, all pixels are drawn, but slices are kept: by
/// Changes::Detect as long as a sample's end lies within the depths of the nine pixels around it, by Changes::Objects
/// where no object is. Until the eye is drawn in full again, such a frame differs from the frame in full as far as
/// another jitter's depth does: by less than 2 % of the mean in all pictures of 96 x 64 pixels that were tried, and
/// from Exact by no more than a fifth farther; in pictures of a few pixels or slices it may be more.
struct Reuse {
  Changes changes = Changes::Unknown;
  /// Which of the engine's eyes this is: each has a picture of its own, the last 4 that were drawn are kept.
  std::uint64_t eye = 0;
  /// Changes::Objects: counts the eye's frames; unless it is one more than at the last, all is drawn.
  std::uint64_t frame = 0;
  /// Share of the slices' segments over which, where that goes on, frames are drawn in full and nothing is kept of
  /// them, up to 16 at a time; 0 to 1.
  float fullShare = 0.35F;
  /// Redraw every slice once in so many frames, a part of them in each; 0: never; at most 65536.
  int refreshFrames = 0;
};

/// The vertices of a mesh in a GL buffer: three floats each. They are read back once to fit a box around them, so that
/// from then on a mesh costs what a box does, whatever its triangles. No frame waits for them: they come some frames
/// after the first that names the mesh, 4 MiB a frame, and until then a frame that names it compares all of depth and
/// maps. So it is best named from the frame on in which the eye is drawn in full. The last 1024 meshes are remembered,
/// and for each eye in what version its last frame saw them: a mesh whose vertices the engine changes has a new
/// version, and covers both shapes once they are known. A mesh that the engine changes in every frame, or that a vertex
/// shader deforms (skinning, wind), which has its rest shape in the buffer, is better passed as a box that holds all of
/// its poses, in worldFromObject and lastWorldFromObject.
struct MeshVertices {
  std::uint32_t buffer = 0;  ///< name of a buffer, not mapped but persistently; 0: no mesh
  std::uint64_t offset = 0;  ///< bytes to the first vertex's position
  std::uint32_t stride = 12; ///< bytes from one position to the next, at least 12
  std::uint32_t count = 0;   ///< vertices, 1 to 2^24; all in the buffer and finite, which shows when they have come
  std::uint64_t version = 0; ///< of what the buffer holds, as SceneDepth::version; 0: every frame compares all
};

/// An object that moved, appeared or vanished: what holds all of it in the last frame and in this one, a box or its
/// mesh. The same matrix twice for one that was, or is, in one of the two only.
struct MovingObject {
  /// Places the cube from -1 to 1 around the object, or the mesh from its own coordinates: affine, invertible.
  Mat4 worldFromObject = kIdentity;
  Mat4 lastWorldFromObject = kIdentity; ///< as it was in the eye's last frame
  MeshVertices mesh = {};
};

/// What smoke and hair before the eye leave of the light behind them: curves as Light::curves, but captured from
/// Frame::camera through eyeLight() (tyndall/avsm.h). They dim the medium's light, of all lights and of the
/// surroundings, by what stands before it, and nothing else: the engine draws smoke and hair over its picture by
/// itself, before the effect. Fog that it does not draw, banks of it that Avsm::drawVolumes() captures, say, the effect
/// lights: with an albedo it scatters what it takes, as a medium of its own, and with dimsBackground it dims the
/// picture behind as the medium does. What it takes of light on its way there is for Light::curves to say, into which
/// the same is captured from the light; Light::scatteringScale counts for it, too. Low rank is Tree then, and a change
/// of the curves draws all anew. Lights' programs are others than without, and with an albedo others again: prepare()
/// compiles those of the frame that it is given. Rays to the sky end at Medium::farDistance in fog, too.
struct EyeCurves {
  AvsmCurves curves; ///< of layer 0; texture 0: nothing stands before the eye
  double nearDistance =
      0; ///< where their depth is 0, as eyeLight() was given it: world units, >= 1e-30, of an orthographic camera >= 0
  double farDistance = 0; ///< and 1: at least 1.0001 and, of a perspective camera, at most 1e6 times that; < 1e30
  /// Share that is scattered of the light that the curves take: 0 to 1. 0: none, they only dim. A medium of four
  /// constituents must scatter in each channel in which this does.
  Rgb albedo = {0, 0, 0};
  Phase phase = Phase::Isotropic; ///< by which it is scattered
  float g = 0;                    ///< and its asymmetry, as Constituent::g
  bool dimsBackground = false;    ///< they dim the picture behind, too, Output::transmittance and that of a Lookup
};

/// Textures of the engine's own to write instead of, or besides, blending into Frame::colour. GL_TEXTURE_2D, a float
/// colour format (RGBA16F, RGBA32F, R11F_G11F_B10F, RGB16F, RGB32F), as large as colour.
struct Output {
  std::uint32_t inscatter = 0;     ///< receives the inscattered radiance; 0: not wanted
  std::uint32_t transmittance = 0; ///< receives T(d) per channel; 0: not wanted
  int layer = -1;                  ///< of both, if they are GL_TEXTURE_2D_ARRAYs; -1: they are GL_TEXTURE_2Ds
};

/// Light of camera rays up to a set of distances, for what is drawn after the effect and has no depth of its own in the
/// frame's: particles, panes, leaves. shaftsLookupSource() has the call for their shaders. It is made from the same
/// shadow-map rows, trees and slices as the picture, so not with Technique::Exact. Layer i of n is light up to the
/// distance near (far / near)^(i / (n - 1)) of a perspective camera's eye, or of an orthographic one's near plane,
/// whatever the scene depth. While it is drawn a texture of the effect's own holds 16 bytes for each texel of a layer.
/// With Frame::reuse it is drawn whole, but in a frame in which nothing has changed: the textures are then taken to
/// hold what the effect has last written into textures of these names, and stay as they are.
struct Lookup {
  /// GL_TEXTURE_2D_ARRAY, a float colour format as Output's, whose texels all show the viewport: 1 x 1 to 512 x 512, 2
  /// to 64 layers. Receives inscattered radiance; 0: none is wanted
  std::uint32_t inscatter = 0;
  std::uint32_t transmittance = 0; ///< as large and deep; receives T per channel; 0: not wanted
  double nearDistance = 0;         ///< of the first layer, world units, finite and > 0
  double farDistance = 0;          ///< of the last, finite, > nearDistance and at most 1e12 times that
};

/// GLSL of tyndallShafts(windowPosition, distance), which a shader of #version 330, or 300 es, or later includes: the
/// inscatter and the transmittance before a point, of a Lookup.
const char* shaftsLookupSource();

/// All that one render() call reads. Every texture keeps its parameters; the effect binds samplers of its own. Relative
/// to the eye, matrices, planes and depth scales are finite as 32-bit floats; lights may be as far as doubles are.
struct Frame {
  /// Pixels of colour and outputs that the camera's image fills, 1 to 16384 wide and high; no other is read or written.
  Rectangle viewport;
  std::uint32_t colour = 0; ///< back buffer, GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY, linear HDR radiance in a float
                            ///< format: blended in place; 0 only with an Output
  int colourLayer = -1;     ///< of an array; -1: colour is none
  SceneDepth depth;
  Camera camera;
  std::vector<Light> lights; ///< at most 16
  Medium medium;
  Ambient ambient;
  EyeCurves eyeCurves;
  Settings settings;
  Output output;
  Lookup lookup;
  Reuse reuse;
  std::vector<MovingObject> objects; ///< for Changes::Objects: all that moved since the eye's last frame
};

// ---------------------------------------------------------------------------------------------------------------------
// The effect

/// How a pass is kept to the pixels that it is for.
enum class Masking {
  Auto,    ///< as the renderer's row of the table of tunings has it
  Stencil, ///< those pixels, by a stencil test before they are shaded
  Tiles,   ///< squares of 16 x 16 pixels that hold one are drawn, the others are not
};

/// How colour * transmittance + inscatter comes into Frame::colour.
enum class Compositing {
  Auto,       ///< as the table of tunings has it
  DualSource, ///< by dual-source blending; where the context has none, as Copy
  Copy, ///< from a copy of the colour, blended in a shader: inscatter, transmittance and copy are textures of ours
};

/// What makes a frame faster or slower, never another: each choice gives the same picture. What is left to the effect
/// it takes from a table of renderers (src/Tuning.cpp), by what GL says that it draws with: software or a GPU.
struct Tuning {
  Masking reuse = Masking::Auto; ///< Frame::reuse: the pixels that have changed
  Masking fixup = Masking::Auto; ///< Technique::Epipolar: the pixels that no sample serves
  Compositing compositing = Compositing::Auto;
  /// Milliseconds that a draw may take on a slow GPU, at most 10000: a driver resets one that takes longer than half a
  /// second to two seconds. A draw that may take longer, by its rays and the shadow texels that they may cross, is
  /// drawn in bands, each handed to the GPU by itself; timer queries of earlier frames correct the guess. 0: none is;
  /// negative: as the table of tunings has it.
  double bandMilliseconds = -1;
};

/// How the time of a pass is taken: not at all, by GL timer queries, or by wall clock around glFinish.
enum class PassTiming { Off, TimerQuery, Finish };

/// What became of one pass in the last frame.
struct PassStatistics {
  std::string name;
  std::string skipped;     ///< why it did not run; empty if it ran
  double milliseconds = 0; ///< 0 if skipped or not timed
  int bands = 0;           ///< draws that it took, more than one by Tuning::bandMilliseconds; 0 if skipped
  double longestBand = 0;  ///< of them, in milliseconds; as those, and by PassTiming::Finish with a glFinish for each
};

/// OpenGL ES has no query that counts samples: fixupPixels, redrawnShare and the estimate of errors are 0 there, and
/// marchedSamples and drawnSlices leave out what only a query tells.
struct Statistics {
  std::vector<PassStatistics> passes;
  /// GL memory the effect holds in textures and buffers: at most what the last 8 frames needed, of each of the last 4
  /// eyes that are kept
  std::uint64_t bytes = 0;
  int compiledPrograms = 0; ///< programs built so far
  /// Pixels that epipolar samples did not serve: they were marched by themselves or, with an errorTarget, some given
  /// the share of light of the samples around.
  std::uint64_t fixupPixels = 0;
  /// Camera rays integrated, over all lights, and over parts of a light's shadow views where those are too large to be
  /// marched at once; march samples that are integrated together, up to two of a slice, count as one.
  std::uint64_t marchedSamples = 0;
  /// Epipolar: slices of all lights that were drawn, with an errorTarget rounded up to eights; with Frame::reuse all of
  /// those lights of which something was drawn.
  std::uint64_t drawnSlices = 0;
  /// Settings::errorTarget: what a light's inscatter is expected to be off by for want of slices, for the light that it
  /// is most for: root mean square as a part of the light's mean, to a twentieth; more than the target where that is
  /// missed. And the share of the image that is off by more than the target, which may be much though the image as a
  /// whole meets it. 0 without one.
  double errorEstimate = 0;
  double shareOverTarget = 0;
  /// Share of the slices' segments, over all lights, that were marched: 1 for a frame drawn in full, 0 for one that
  /// only composites what is kept.
  double redrawnShare = 1;
  /// With DebugView::NodeVisits what that view shows, as a mean over the image: nodes and groups of texels that a ray
  /// looks at, in all shadow views of the first light. Else 0.
  double visitsPerRay = 0;
  /// Config::tuning, with what the effect took where that left it the choice, or where the context has no other.
  Tuning tuning = {};
  /// What is allowed but seldom meant, and what is probably wrong with the picture then: a line each, as
  /// Status::message.
  std::vector<std::string> warnings = {};
};

/// Resolves a GL function by name: glfwGetProcAddress, eglGetProcAddress, SDL_GL_GetProcAddress, gladGetProcAddress or
/// a function of the engine's (a lambda that captures nothing), which return void* or a pointer to a function.
class GlLoader {
public:
  using Untyped = void* (*)(const char* name);
  using Typed = void (*(*)(const char* name))();

  GlLoader(std::nullptr_t = nullptr) {}
  template <typename Function, std::enable_if_t<std::is_convertible_v<Function, Untyped>, int> = 0>
  GlLoader(Function function) : untyped_(function) {}
  template <typename Function, std::enable_if_t<std::is_convertible_v<Function, Typed>, long> = 0>
  GlLoader(Function function) : typed_(function) {}

  explicit operator bool() const { return untyped_ || typed_; }
  void* operator()(const char* name) const { return typed_ ? reinterpret_cast<void*>(typed_(name)) : untyped_(name); }

private:
  Untyped untyped_ = nullptr;
  Typed typed_ = nullptr;
};

/// Where an engine keeps linked programs from one run to the next, so that they need not be compiled again. A key is a
/// file name of letters, digits, '-' and '_'; it holds what the bytes depend on: shader texts, driver, GL version.
/// Without both functions nothing is kept. Called during prepare(), render() and compileAll(), on their thread.
struct ProgramStore {
  std::function<std::vector<std::uint8_t>(const std::string& key)> load; ///< empty for a key that is not known
  std::function<void(const std::string& key, const std::vector<std::uint8_t>& bytes)> save;
};

/// What becomes of the GL state that a call changes.
enum class StateMode {
  Restore, ///< on return it equals that on entry
  Leave,   ///< it is left as said at Effect, without asking for what it was: queries stall threaded drivers
};

struct Config {
  GlLoader loader = nullptr;
  PassTiming timing = PassTiming::Off;
  ProgramStore programs = {};
  StateMode state = StateMode::Restore;
  Tuning tuning = {};
  /// Compares scene depth and shadow maps by a small extra pass a light and frame, and warns (Statistics::warnings), a
  /// few frames later, where they cannot show one scene: what a wrong matrix, projection or encoding comes to. For
  /// while one integrates.
  bool checkInputs = false;
  bool warningsAreErrors = false; ///< InvalidFrame, and nothing is drawn, for what would be a warning: the first
  /// For tools that must answer while a frame takes long: called by render() between draws, and between the bands of
  /// one (Tuning::bandMilliseconds). It may wait for GL, and make another context current for a while; of this one it
  /// leaves all state as it is. It calls nothing of the effect, and does not throw. False: no more is drawn, and
  /// render() returns Abandoned; what was drawn into colour and outputs stays. Timer queries of passes count its time.
  std::function<bool()> betweenDraws = nullptr;
};

/// How far Effect::prepare() is.
struct PrepareStatus {
  Status status;
  int left = 0; ///< programs that are still being compiled
  bool ready() const { return static_cast<bool>(status) && left == 0; }
};

struct CreateResult;

/// With StateMode::Leave render(), prepare() and compileAll() leave: program, vertex array, draw framebuffer,
/// renderbuffer, the buffers for uniforms (bindings 0 to 2 too) and for unpacking pixels 0, and the read framebuffer if
/// a layer or a viewport that does not begin at (0, 0) was copied; texture units, as many as it used from 0 on, without
/// textures and samplers, unit 0 active; GL_UNPACK_* at their defaults; blending off, its
/// equations GL_FUNC_ADD, its factors GL_ONE and GL_ZERO, all colours written, for all draw buffers; the stencil's
/// function, operation and mask at their defaults; polygons filled; clip control at its default; off: culling, depth,
/// stencil and scissor test, logic operation, rasterizer discard, sRGB framebuffers, sample mask and coverage, alpha to
/// coverage and to one, smooth polygons, dithering, clip distances; the viewport as wide and high as the frame, or as
/// it was if nothing was drawn; the scissor box of the first viewport, where a draw was drawn in bands, that of the
/// last one. In the compatibility profile also: alpha test, polygon stipple and two-sided stencil test off, the
/// stencil's front face active, GL_CLAMP_FRAGMENT_COLOR and glPixelTransfer's scales, biases and GL_MAP_COLOR at their
/// defaults. create() and a call that finds no context, another one, transform feedback active, a display list being
/// compiled or a glRenderMode other than GL_RENDER leave all as it was.
class Effect {
public:
  /// Builds an effect in the current context: OpenGL 3.3 or later, core or compatibility profile, or OpenGL ES 3.2 with
  /// GL_EXT_float_blend. Shaders compile when first needed.
  static CreateResult create(const Config& config);
  ~Effect();
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;

  /// Compiles what this frame can need, what its reuse and its fix-up can need included, so that render() of frames
  /// like it compiles nothing. Draws nothing. With GL_KHR_parallel_shader_compile it does not wait: call it again, once
  /// a frame, until ready(), and skip the effect until then; without, it returns when all is compiled. The status is
  /// render()'s for a frame that breaks a rule, ShaderError for a program that does not build.
  PrepareStatus prepare(const Frame& frame);

  /// Adds the shafts to the frame. Unless the status is Ok, or Abandoned, nothing was drawn, and colour and outputs are
  /// untouched, whatever failed. Does not wait for the GPU. Frames like those before make no GL object. GL state on
  /// return is as Config::state says. GL errors of the engine's that it has not asked for are pending still.
  Status render(const Frame& frame);

  /// About the last render(); waits for the GPU.
  Statistics statistics();

  /// Compiles every shader variant now instead of when first needed.
  Status compileAll();

private:
  struct State;
  explicit Effect(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct CreateResult {
  std::unique_ptr<Effect> effect; ///< null unless status is Ok
  Status status;
};

} // namespace tyndall
