// Light of the surroundings along one ray, in double precision: phase functions are integrated over the sphere.
#pragma once

#include "Optics.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace reference {

/// False if no light comes from the surroundings.
bool isLit(const tyndall::Ambient& ambient);

/// Radiance that comes from a side: a unit vector that points there.
Rgb radianceFrom(const tyndall::Ambient& ambient, const glm::dvec3& side);

/// Integral of a constituent's phase function times that radiance, over all sides, for light that travels against a
/// ray's direction to the eye. To about 1e-9 of the brightest side's.
Rgb scatteredRadiance(const tyndall::Constituent& constituent, const tyndall::Ambient& ambient,
                      const glm::dvec3& direction);

/// What the medium scatters of it along a ray.
Airlight ambientAirlight(const tyndall::Medium& medium, const tyndall::Ambient& ambient, const Ray& ray);

/// What it adds up to `end`, which may be infinite.
Rgb ambientLight(const tyndall::Medium& medium, const tyndall::Ambient& ambient, const Ray& ray, double end);

/// Values of an image over the frame, row 0 at the bottom.
struct Occlusion {
  int width = 0, height = 0; ///< 0: nothing is hidden
  std::vector<float> shares;
};

/// The share at a place of the image, 0 to 1 across and up: bilinear between texel centres, clamped at the edges.
double openShare(const Occlusion& occlusion, double x, double y);

} // namespace reference
