// Segments into an Avsm of the test context, and its curves back.
#pragma once

#include "gl/Objects.h"
#include "reference/Curves.h"
#include "support/TestContext.h"

#include <glm/glm.hpp>
#include <tyndall/avsm.h>
#include <vector>

namespace tests {

/// True if the test context is new enough; else says that the test is skipped.
bool hasAvsm();

bool hasExtension(const std::string& name);

tyndall::AvsmConfig configOf(tyndall::CurveReduction reduction, int size, int nodes = 8, bool packed = false);

/// A segment as it is given to tyndallCapture().
struct Captured {
  glm::ivec3 texel{0};
  float entry = 0, exit = 0, transmittance = 1;
};

/// Balls of smoke in every view: radii as parts of the map, places and thicknesses in depth, of each the least and how
/// much more at most.
struct Puffs {
  int size = 64, views = 1, count = 10;
  glm::vec2 radius{0.1F, 0.15F}, depth{0, 1}, thickness{0.05F, 0.1F};
  float density = 12; ///< optical depth a unit of depth
  bool solid = true;  ///< the first of each view lets nothing through
};
std::vector<Captured> segmentsOf(const Puffs& puffs, unsigned seed);

/// Light along -z through the cube from -1 to 1, so that depth is (1 - z) / 2.
tyndall::Light parallelLight();

/// A spot at (0, 0, 2) that shines along -z.
constexpr double kSpotNear = 0.5, kSpotFar = 8;
tyndall::Light spotLight(bool reversed);
double depthOfSpot(); ///< of the spot itself, before its near plane

/// Depth and transmittance of the nodes of a texel's curve.
using Curve = std::vector<glm::dvec2>;

/// The curve at a depth, by lines; `exponential`: as avsmLookup does it if told.
double curveAt(const Curve& curve, double depth, bool exponential = false);

/// Mean absolute difference between a curve and the segments it is made of, over [0, 1] in depth.
double curveError(const Curve& curve, const std::vector<reference::Segment>& segments);

/// Node by node, depths and transmittances.
void checkNear(const Curve& a, const Curve& b, double margin);

/// begin(), and a compute shader that captures these, in an order of the driver's.
void captureInto(tyndall::Avsm& avsm, const std::vector<Captured>& segments);

/// begin(), and one invocation that captures these, the last one first: CurveReduction::InOrder inserts them in the
/// order of the vector.
void captureLastFirst(tyndall::Avsm& avsm, const std::vector<Captured>& segments);

/// After beginStreaming(): one invocation that inserts these in order, by avsmInsert's image.
void insertByImage(tyndall::Avsm& avsm, const std::vector<Captured>& segments);

class AvsmRig {
public:
  explicit AvsmRig(const tyndall::AvsmConfig& config = {});

  tyndall::Avsm& avsm() { return *avsm_; }

  /// captureInto(), resolve(), and waits.
  void capture(const std::vector<Captured>& segments);

  /// The curves' texture as it is.
  std::vector<std::uint32_t> bits() const;

  /// The curve of a texel, from the texture.
  Curve curve(const glm::ivec3& texel) const;

  /// All curves, for the reference.
  reference::CurveMap map() const;

  /// avsmLookup in a shader: texel by texel, or bilinearly at a place of the map.
  std::vector<float> lookUp(const std::vector<glm::ivec3>& texels, const std::vector<float>& depths,
                            bool exponential = false) const;
  std::vector<float> lookUpBilinear(const std::vector<glm::vec2>& places, int layer,
                                    const std::vector<float>& depths) const;

private:
  std::vector<float> run(const std::string& expression, const std::vector<glm::vec4>& inputs, bool exponential) const;

  tyndall::AvsmConfig config_;
  std::unique_ptr<tyndall::Avsm> avsm_;
};

} // namespace tests
