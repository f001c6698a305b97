// Adaptive volumetric shadow maps (Salvi et al. 2013): how much of a light smoke, hair and the like let through, for
// every texel of a map a curve over depth. Surfaces look it up (glsl avsmLookup), and the shafts too (Light::curves).
//
//     avsm->begin();                        // empty lists, bound for the engine's shaders
//     ... the engine draws its smoke from the light's view; each fragment calls tyndallCapture() (glsl avsmCapture) ...
//     avsm->resolve();                      // lists -> curves
//     frame.lights[0].curves = avsm->curves();
//
// Or in a fixed memory, each segment inserted as it comes (the paper's 4.3):
//
//     avsm->beginStreaming();               // curves through which all light passes
//     avsm->drawParticles(light, smoke);    // spheres from a buffer of the engine's; any number of calls
//     avsm->bindCurves(0);                  // and, or instead, the engine draws: each fragment calls tyndallInsert()
//     avsm->resolve();                      // (glsl avsmInsert)
//     frame.lights[0].curves = avsm->curves();
//
// Either way fog and smoke whose density a 3D texture holds need no particles:
//
//     avsm->drawVolumes(light, volumes);    // boxes and spheres, after begin() or beginStreaming()
//
// The map has the light's shadow views, at a size of its own; engines that draw into it with glClipControl's
// GL_UPPER_LEFT give its views matrices whose row y is negated, as for a shadow map. Depth in it is linear along the
// view, 0 at its near and 1 at its far plane. All functions need the GL context current that create() saw: OpenGL 4.3
// core or later. A call whose status is not Ok leaves curves and lists as they were. GL errors of the engine's that it
// has not asked for are pending still. With StateMode::Leave resolve(),
// beginStreaming(), drawParticles() and drawVolumes() leave GL as said at Effect but for the viewport, which they do
// not touch, storage buffer bindings 0 to 2 and image unit 0 empty but for the lists where begin() bound them, and
// GL_TEXTURE_3D of texture units 0 and 1 without a texture; these and begin() leave the generic binding of storage
// buffers 0.
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall {

/// How a curve is made of a texel's captured segments.
enum class CurveReduction {
  Fitted, ///< insertion in the order of capture into eight nodes more, of which those stay that count most, refitted;
          ///< another order moves it by about half its error
  WholeCurve, ///< of all ends of segments those stay that count most, refitted: the most exact, whatever the order
  Sorted,     ///< the paper's insertion, in the order of depth: the same curve whatever the order of drawing
  InOrder,    ///< the paper's insertion, the segment captured last first: no sort, may flicker a little
};

struct AvsmConfig {
  GlLoader loader = nullptr;
  PassTiming timing = PassTiming::Off;
  int size = 256;     ///< texels per side, 1 to 4096
  int layers = 1;     ///< one for each shadow view of the light, 1 to 6
  int nodes = 8;      ///< of a curve: 4, 8, 12 or 16
  bool packed = true; ///< 16 bits for a depth and for a transmittance, else 32
  CurveReduction reduction = CurveReduction::Fitted;
  /// Bytes that the lists may grow to, as far as frames need them; what is over is lost, in each list the deepest
  /// segments. At least one segment for each texel fits whatever this says.
  std::uint64_t mostListBytes = std::uint64_t{512} << 20;
  ProgramStore programs = {};
  StateMode state = StateMode::Restore;
};

/// About the last resolve(). Reading it waits for the GPU.
struct AvsmStatistics {
  std::vector<PassStatistics> passes;
  std::uint64_t segments = 0;   ///< captured; 0 of what was streamed
  std::uint64_t lost = 0;       ///< of these not kept, for want of memory or because over 4096 met in one texel
  std::uint64_t listBytes = 0;  ///< GL memory of lists
  std::uint64_t curveBytes = 0; ///< and of curves
};

/// Spheres of an even medium in a GL buffer, as smoke that an engine simulates. A ray that runs a length l through one
/// lets exp(-density l) of the light through. Spheres overlap freely: what they let through multiplies.
struct AvsmParticles {
  /// Name of a buffer, not mapped but persistently. A particle is five floats: its centre's x, y, z and radius in world
  /// units, and its density, which is the extinction coefficient in 1/world unit: -log(t) / (2 radius) if the share t
  /// is to come through its centre. One whose radius or density is not above 0, or not a number, is left out.
  std::uint32_t buffer = 0;
  std::uint64_t offset = 0;  ///< bytes to the first particle, a multiple of 4
  std::uint32_t stride = 20; ///< bytes from one particle to the next, a multiple of 4 from 20 to 256
  std::uint32_t count = 0;   ///< particles, all in the buffer
  Vec3 origin = {0, 0, 0};   ///< world position that the centres are relative to: near them, floats are exact
};

/// A part of space with fog or smoke in it. Its extinction is `extinction` times its density times how far it has faded
/// in. Volumes overlap freely: what they let through multiplies.
struct AvsmVolume {
  enum class Shape { Box, Sphere };
  Shape shape = Shape::Box;
  Mat4 worldFromVolume = kIdentity; ///< places the cube, or the unit sphere, from -1 to 1: affine, invertible
  double extinction = 0;            ///< where density is 1, 1/world unit, 0 to 1e30
  /// Share of the half extent, of a sphere of the radius, over which density rises from 0 at the border, by Hermite's
  /// cubic: 0 to 1; 0: a hard edge.
  double fade = 0;
  std::uint32_t density = 0; ///< GL_TEXTURE_3D, R8, R16, R16F or R32F, level 0, of any size, that fills the cube,
                             ///< trilinear; negative and NaN as 0. 0: 1 everywhere
  std::uint64_t version = 0; ///< of what it holds, another texture of the same name included: the bricks that are empty
                             ///< are looked for again unless it is as at the last call that named the texture, in the
                             ///< last 8 frames, and not 0
};

struct AvsmResult;

class Avsm {
public:
  static AvsmResult create(const AvsmConfig& config);
  ~Avsm();
  Avsm(const Avsm&) = delete;
  Avsm& operator=(const Avsm&) = delete;

  /// Empties the lists, makes room for as many segments as the last frames needed, and binds them as shader storage
  /// buffers `firstBinding` and the next, where they stay until the engine binds others.
  Status begin(std::uint32_t firstBinding = 0);

  /// Instead of begin(): makes curves through which all light passes, into which segments are inserted as they come
  /// (Salvi et al. 2013, 4.1), in the order of drawing, whatever AvsmConfig::reduction says. No more memory is needed
  /// than that of the curves. GL state on return is as AvsmConfig::state says.
  Status beginStreaming();

  /// After beginStreaming(): inserts particles, seen through the light's shadow views, each in a layer's place, in
  /// the order of the buffer (4.3; a tile of texels walks through all of them). The nearer to the light the first, the
  /// better the curves: in the order of depth they are those of CurveReduction::Sorted. Packed curves are rounded to 16
  /// bits after each 4,096 particles and at the end. Nothing is drawn unless the status is Ok; it is InvalidFrame for
  /// a field that breaks its rule, a light without shadow views or with more than the map has layers, and a view for
  /// which avsmDepth() fails. GL state on return is as AvsmConfig::state says.
  Status drawParticles(const Light& light, const AvsmParticles& particles);

  /// After begin() or beginStreaming(): captures, or inserts in their order, at most 8 volumes, seen through the
  /// light's shadow views, each in a layer's place. Segments follow their optical depth along each texel's ray to 0.001
  /// of the transmittance. A view's texels that a volume cannot reach cost nothing. Nothing is drawn unless the status
  /// is Ok; InvalidFrame as for drawParticles(). Lists stay bound where begin() bound them. GL state on return is as
  /// AvsmConfig::state says.
  Status drawVolumes(const Light& light, const std::vector<AvsmVolume>& volumes);

  /// After beginStreaming(): binds as draw framebuffer one whose colour attachments are the curves of a layer, for
  /// shaders that include avsmInsert and call tyndallInsert(), which needs GL_EXT_shader_framebuffer_fetch. It stays
  /// until the engine binds another; no other state is changed: the viewport should be (0, 0, size, size), blending,
  /// depth and stencil test off, all colours written. InvalidFrame for a layer that the map does not have and where the
  /// context cannot draw into curves.
  Status bindCurves(int layer);

  /// Makes the curves of what was captured since begin(), or ends what beginStreaming() began. Waits for the GPU while
  /// nothing was captured in the newest frame that is known, the last or the one before: so that frames without smoke
  /// have no curves. An engine that knows that it has none calls neither begin() nor this. GL state on return is as
  /// AvsmConfig::state says.
  Status resolve();

  /// The curves, for Light::curves and for shaders that include avsmLookup. Their texture is 0 while nothing is known
  /// to be captured: nothing dims the light. After beginStreaming() it is never 0, so that an engine can bind it as an
  /// image, too (glsl avsmInsert).
  AvsmCurves curves() const;

  AvsmStatistics statistics();

private:
  struct State;
  explicit Avsm(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct AvsmResult {
  std::unique_ptr<Avsm> avsm; ///< null unless status is Ok
  Status status;
};

/// The depth of an AVSM as a function of a world position p: dot(depth.xyz, p) + depth.w, 0 at the near and 1 at the
/// far plane of one of the light's shadow views. InvalidFrame for a view that the light does not have, a matrix
/// that is singular or has its far plane at infinity, and a light without a finite direction or position.
Status avsmDepth(const Light& light, int view, std::array<double, 4>& depth);

/// A light that stands at the eye and shines through the image, without the camera's jitter, of an orthographic camera
/// with it: its only shadow view is what the camera sees between two planes, all of the viewport, whatever the map's
/// shape, by the camera's clip depth convention. For what an engine captures for Frame::eyeCurves: its matrix draws,
/// avsmDepth() and drawParticles() take it; it is none of Frame::lights. Distances are along the view's axis, from the
/// eye or from an orthographic camera's near plane, as EyeCurves has their rules. InvalidFrame, and the light as it
/// was, for others and for a viewport or a camera that breaks its rules.
Status eyeLight(const Camera& camera, const Rectangle& viewport, double nearDistance, double farDistance, Light& light);

/// The text of avsmCapture, avsmInsert and avsmLookup, for engines that build shaders from strings. Installed as files,
/// too, in share/tyndall/glsl.
const char* avsmCaptureSource();
const char* avsmInsertSource();
const char* avsmLookupSource();

} // namespace tyndall
