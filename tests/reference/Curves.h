// Transmittance of segments along one light ray in double precision (DESIGN 1, A; Salvi et al. 2013, eq. 1).
#pragma once

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace reference {

/// Between two depths a part of the light passes, evenly; a step where both are the same.
struct Segment {
  double entry = 0;
  double exit = 0;
  double transmittance = 1;
};

/// The product of what all segments let through up to a depth; a step counts at its own depth.
double transmittanceAt(const std::vector<Segment>& segments, double depth);

/// Curves of a light as read back from GL: depth and transmittance of the nodes, texel by texel (row 0 at the bottom),
/// view by view. Lines between nodes; 1 before the first, the last one's value behind it.
struct CurveMap {
  int size = 0; ///< texels per side; 0: nothing dims the light
  std::vector<std::vector<glm::dvec2>> curves;
};

/// What passes to a point that the first view that holds it decides on; 1 in none, and before near planes. Cells are
/// texels along the main axis that `direction`, a movement of the point, has in the map; across it the two nearest
/// texels are weighted linearly.
double dimming(const CurveMap& map, const tyndall::Light& light, const glm::dvec3& point, const glm::dvec3& direction);

/// Curves that were captured from a camera (Frame::eyeCurves): depth is linear along the view's axis, from `near` to
/// `far` from the eye or from an orthographic camera's near plane.
struct EyeCurveMap {
  CurveMap map; ///< size 0: nothing stands before the eye
  double near = 0, far = 1;
  tyndall::Constituent fog;    ///< scattering: albedo of what the curves take
  bool dimsBackground = false; ///< of the picture behind, too
};

/// What passes along a ray through a place of the image, 0 to 1 across and up, at so many depths as curves bend at:
/// between two of them it changes evenly. Bilinear between texel centres.
class EyeDimming {
public:
  /// advance: axial distance that a unit of the ray's length is.
  EyeDimming(const EyeCurveMap& map, double x, double y, double advance);

  /// Distances along the ray, ascending.
  const std::vector<double>& bends() const { return bends_; }

  double at(double s) const;

  /// The same where between two nodes of a curve an even medium is: what fog is taken to be.
  double inFogAt(double s) const;

private:
  template <typename OnCurve>
  double meanAt(double s, const OnCurve& onCurve) const;

  const EyeCurveMap& map_;
  double advance_;
  std::vector<std::size_t> texels_;
  std::vector<double> weights_;
  std::vector<double> bends_;
};

} // namespace reference
