// Smoke as soft balls: where each is at a time, in closed form, so that any frame can be drawn without those before it.
#pragma once

#include "scene/Scene.h"

namespace host {

/// A ball of smoke. Extinction at a distance r from its middle is density (1 - (r / radius)^2)^2: 0 with its slope at
/// the rim. A straight line that passes the middle at a distance b has the chord h = sqrt(radius^2 - b^2) to either
/// side, and the optical depth density 16/15 h^5 / radius^4.
struct SmokeParticle {
  glm::dvec3 position{0};
  double radius = 0;  ///< world units
  double density = 0; ///< 1/world unit
  glm::vec3 albedo{1};
};

/// All particles of the scene at a time, emitter by emitter. They are born evenly in time over the emitter's disc, rise
/// with its drift, grow, are carried by eddies and fade, in and out; density times radius stays but for the fading.
/// An emitter's node may move: particles go on from where it was at their birth.
std::vector<SmokeParticle> smokeAt(const Scene& scene, double seconds);

/// A box around the particles of an emitter at a time; of a node that does not move, the same at any time.
Bounds smokeBounds(const Scene& scene, const SmokeEmitter& emitter, double seconds);

} // namespace host
