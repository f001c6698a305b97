// A scene's strands as one of its lamps sees them, places on them that it lights, and how much of its light comes there
// by geometry.
#pragma once

#include "Methods.h"
#include "Stage.h"

#include <gl/VolumeRenderer.h>
#include <scene/Scene.h>
#include <scene/Strands.h>

namespace avsmbench {

/// A place on a strand.
struct Receiver {
  glm::dvec3 place{0};
  int segment = 0; ///< of the strands
};

class Hair {
public:
  /// The first lamp of the scene, and so many places, spread over all strands. Throws host::Error if the scene lacks
  /// strands or a spot.
  Hair(const host::Scene& scene, int receivers);
  Hair(host::Strands strands, tyndall::Light lamp, int receivers);

  /// A method's answers, of a map of its size. As the host lights strands, places are asked for 1.5 widths before their
  /// own, or 1.5 texels where those are less.
  std::vector<float> answers(const MethodEntry& entry, tyndall::Avsm& lists, const tyndall::AvsmConfig& config);

  /// The light that comes to a disc around each place, in world units across; 0: to the place.
  std::vector<double> truth(double footprint) const;

  const std::vector<Receiver>& receivers() const { return receivers_; }

private:
  host::Strands strands_;
  tyndall::Light lamp_;
  std::vector<Receiver> receivers_;
  host::VolumeRenderer renderer_;
};

/// Mean of |difference|.
double meanDifference(const std::vector<float>& answers, const std::vector<double>& truth);

} // namespace avsmbench
