// What passes over particles and volumes are given of a light, its shadow views; and whether particles can be drawn.
#pragma once

#include "gl/Functions.h"

#include <array>
#include <glm/glm.hpp>
#include <tyndall/avsm.h>

namespace tyndall::avsm {

/// As the shader has it (std140).
struct ParticleView {
  using Row = std::array<float, 4>;
  std::array<Row, 3> near, far; ///< points of a texel's ray, homogeneous, by x, y and 1 of a place in texels
  std::array<Row, 3> rows;      ///< texelFromWorld: x, y and the weight, positive before the light
  Row behindLight;              ///< x: depth, before which there is no light
};
inline ParticleView::Row rowOf(const glm::dvec4& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(v.w)};
}
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
