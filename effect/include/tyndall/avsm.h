// Adaptive volumetric shadow maps (Salvi et al. 2013): how much of a light smoke, hair and the like let through, for
// every texel of a map a curve over depth. Surfaces look it up (glsl avsmLookup), and the shafts too (Light::curves).
//
//     avsm->begin();                        // empty lists, bound for the engine's shaders
//     ... the engine draws its smoke from the light's view; each fragment calls tyndallCapture() (glsl avsmCapture) ...
//     avsm->resolve();                      // lists -> curves
//     frame.lights[0].curves = avsm->curves();
//
// The map has the light's shadow views, at a size of its own. Depth in it is linear along the view, 0 at its near and 1
// at its far plane. All functions need the GL context current that create() saw: OpenGL 4.3 core or later.
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall {

/// How a curve is made of a texel's segments.
enum class CurveReduction {
  WholeCurve, ///< of all ends of segments those stay that count most, refitted: the most exact, whatever the order
  Sorted,     ///< the paper's insertion, in the order of depth: the same curve whatever the order of drawing
  InOrder,    ///< the paper's insertion, as segments came: no sort, may flicker a little
};

struct AvsmConfig {
  GlLoader loader = nullptr;
  PassTiming timing = PassTiming::Off;
  int size = 256;     ///< texels per side, 1 to 4096
  int layers = 1;     ///< one for each shadow view of the light, 1 to 6
  int nodes = 8;      ///< of a curve: 4, 8, 12 or 16
  bool packed = true; ///< 16 bits for a depth and for a transmittance, else 32
  CurveReduction reduction = CurveReduction::WholeCurve;
  /// Bytes that the lists may grow to, as far as frames need them; what is over is lost, in each list the deepest
  /// segments. At least one segment for each texel fits whatever this says.
  std::uint64_t mostListBytes = std::uint64_t{512} << 20;
};

/// About the last resolve(). Reading it waits for the GPU.
struct AvsmStatistics {
  std::vector<PassStatistics> passes;
  std::uint64_t segments = 0;   ///< captured
  std::uint64_t lost = 0;       ///< of these not kept, for want of memory or because over 4096 met in one texel
  std::uint64_t listBytes = 0;  ///< GL memory of lists
  std::uint64_t curveBytes = 0; ///< and of curves
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

  /// Makes the curves of what was captured since begin(). GL state on return equals GL state on entry.
  Status resolve();

  /// The curves, for Light::curves and for shaders that include avsmLookup. Their texture is 0 while nothing is known
  /// to be captured: nothing dims the light.
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
/// far plane of one of the light's shadow views. Fails for a view that the light does not have, a matrix that is
/// singular or has its far plane at infinity.
Status avsmDepth(const Light& light, int view, std::array<double, 4>& depth);

/// The text of avsmCapture and avsmLookup, for engines that build shaders from strings. Installed as files, too, in
/// share/tyndall/glsl.
const char* avsmCaptureSource();
const char* avsmLookupSource();

} // namespace tyndall
