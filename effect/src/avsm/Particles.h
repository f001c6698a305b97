// What passes/avsmParticles.comp is given: the light's shadow views, and whether particles can be drawn at all.
#pragma once

#include "gl/Functions.h"

#include <array>
#include <tyndall/avsm.h>

namespace tyndall::avsm {

/// As the shader has it (std140).
struct ParticleView {
  using Row = std::array<float, 4>;
  std::array<Row, 3> near, far; ///< points of a texel's ray, homogeneous, by x, y and 1 of a place in texels
  std::array<Row, 3> rows;      ///< texelFromWorld: x, y and the weight, positive before the light
  Row behindLight;              ///< x: depth, before which there is no light
};
using ParticlesBlock = std::array<ParticleView, kMaxShadowViews>;

/// Particles of one dispatch: a driver may cut an invocation that loops for long short.
inline constexpr std::uint32_t kMostParticles = 4096;
inline constexpr std::uint32_t kParticleBytes = 20;

/// Of a light whose views are drawn into a map of so many layers.
Status checkViews(const Light& light, int layers);

/// Every rule of the arguments of Avsm::drawParticles. Binds to the generic storage target.
Status checkParticles(const gl::Functions& gl, const Light& light, const AvsmParticles& particles, int layers);

/// Of particles that are relative to `origin`, in a map of `size` texels a side. checkParticles() must have passed.
ParticlesBlock particlesBlock(const Light& light, const Vec3& origin, int size);

} // namespace tyndall::avsm
