#include "avsm/Particles.h"

#include "avsm/CheckAvsm.h"
#include "gl/Enums.h"
#include "optics/Matrices.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::avsm {

namespace {

Status checkBuffer(const gl::Functions& gl, const AvsmParticles& particles) {
  const auto refused = [](const std::string& field, std::uint64_t value, const std::string& rule) {
    return refuse("particles." + field, std::to_string(value), rule);
  };
  if (particles.stride < kParticleBytes || particles.stride > 256 || particles.stride % 4 != 0)
    return refused("stride", particles.stride, "must be a multiple of 4 from 20 to 256");
  if (particles.offset % 4 != 0) return refused("offset", particles.offset, "must be a multiple of 4");
  for (const double value : particles.origin)
    if (!std::isfinite(value)) return refuse("particles.origin", std::to_string(value), "must be finite");
  if (!gl.IsBuffer(particles.buffer))
    return refused("buffer", particles.buffer, "not the name of a buffer in this context (deleted, or never bound?)");
  gl.BindBuffer(gl::SHADER_STORAGE_BUFFER, particles.buffer);
  gl::Int64 size = 0;
  gl.GetBufferParameteri64v(gl::SHADER_STORAGE_BUFFER, gl::BUFFER_SIZE, &size);
  const auto bytes = static_cast<std::uint64_t>(size);
  const std::uint64_t needed = std::uint64_t{particles.stride} * (particles.count - 1) + kParticleBytes;
  if (particles.offset > bytes || needed > bytes - particles.offset)
    return refused("count", particles.count,
                   "these need " + std::to_string(needed) + " bytes from " + std::to_string(particles.offset) +
                       " on, the buffer has " + std::to_string(bytes));
  gl::Int mapped = 0, access = 0;
  gl.GetBufferParameteriv(gl::SHADER_STORAGE_BUFFER, gl::BUFFER_MAPPED, &mapped);
  gl.GetBufferParameteriv(gl::SHADER_STORAGE_BUFFER, gl::BUFFER_ACCESS_FLAGS, &access);
  if (mapped && !(static_cast<gl::Enum>(access) & gl::MAP_PERSISTENT_BIT))
    return refused("buffer", particles.buffer, "it is mapped");
  return {};
}

} // namespace

Status checkViews(const Light& light, int layers) {
  const std::size_t views = light.shadow.views.size();
  if (views < 1 || views > static_cast<std::size_t>(layers))
    return refuse("light.shadow.views.size()", std::to_string(views),
                  "must be 1 to " + std::to_string(layers) + ", the layers of the map");
  for (std::size_t i = 0; i < views; ++i) {
    std::array<double, 4> depth{};
    if (Status s = avsmDepth(light, static_cast<int>(i), depth); !s) return s;
  }
  return {};
}

Status checkParticles(const gl::Functions& gl, const Light& light, const AvsmParticles& particles, int layers) {
  if (Status s = checkViews(light, layers); !s) return s;
  return particles.count == 0 ? Status{} : checkBuffer(gl, particles);
}

ParticlesBlock particlesBlock(const Light& light, const Vec3& origin, int size) {
  ParticlesBlock block{};
  // x and y of clip space to texels
  const glm::dmat4 texelFromDepthClip = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * size, 0.5 * size, 1)) *
                                        glm::translate(glm::dmat4(1), glm::dvec3(1, 1, 0));
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
    const optics::DepthPlane plane = optics::linearDepth(light, static_cast<int>(i));
    const glm::dmat4 texelFromWorld = texelFromDepthClip * optics::depthFromClip(light.shadow.clipDepth) *
                                      optics::toGlm(light.shadow.views[i].clipFromWorld) *
                                      glm::translate(glm::dmat4(1), optics::toGlm(origin));
    const glm::dmat4 worldFromTexel = glm::inverse(texelFromWorld);
    const auto centreAt = [&](double z) { return worldFromTexel * glm::dvec4(0.5 * size, 0.5 * size, z, 1); };
    const auto depthAt = [&](double z) {
      return glm::dot(glm::dvec3(plane.coefficients), glm::dvec3(centreAt(z)) / centreAt(z).w + optics::toGlm(origin)) +
             plane.coefficients.w;
    };
    const bool reversed = depthAt(0) > 0.5;
    const double nearZ = reversed ? 1 : 0;
    const glm::dmat4 rows = glm::transpose(texelFromWorld);
    const auto weightAt = [&](double z) { return glm::dot(rows[3], centreAt(z) / centreAt(z).w); };
    const double nearWeight = weightAt(nearZ), farWeight = weightAt(1 - nearZ);
    ParticleView& view = block[i];
    const auto fill = [&](std::array<ParticleView::Row, 3>& points, double z) {
      const glm::dvec4 columns[3] = {worldFromTexel[0], worldFromTexel[1], worldFromTexel[2] * z + worldFromTexel[3]};
      for (std::size_t k = 0; k < 3; ++k)
        points[k] = rowOf(columns[k] / centreAt(z).w);
    };
    fill(view.near, nearZ);
    fill(view.far, 1 - nearZ);
    const int order[3] = {0, 1, 3};
    for (std::size_t k = 0; k < 3; ++k)
      view.rows[k] = rowOf(rows[order[k]] / nearWeight); // so that the weight is 1 at the near plane
    // The weight, linear along a ray, is 0 at the light; of parallel rays it is the same everywhere.
    const bool parallel = optics::isOrthographic(texelFromWorld);
    view.behindLight = rowOf(glm::dvec4(parallel ? -1e37 : -nearWeight / (farWeight - nearWeight), 0, 0, 0));
  }
  return block;
}

} // namespace tyndall::avsm
