#include "VolumeRig.h"

#include "reference/CameraRays.h"
#include "support/Catch.h"

#include <cmath>
#include <random>
#include <scene/ImageFile.h>

namespace tests {

using host::gl;

DensityTexture::DensityTexture(const glm::ivec3& size, const std::vector<float>& values, GLenum format) {
  grid.size = size;
  gl().BindTexture(GL_TEXTURE_3D, texture.name());
  gl().TexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(format), size.x, size.y, size.z, 0, GL_RED, GL_FLOAT, nullptr);
  fill(values);
}

void DensityTexture::fill(const std::vector<float>& values) {
  grid.values = values;
  gl().BindTexture(GL_TEXTURE_3D, texture.name());
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl().TexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, grid.size.x, grid.size.y, grid.size.z, GL_RED, GL_FLOAT, values.data());
  gl().BindTexture(GL_TEXTURE_3D, 0);
}

std::vector<float> noiseOf(const glm::ivec3& size, float emptyShare, GLenum format, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> values(static_cast<std::size_t>(size.x) * size.y * size.z);
  for (float& value : values) {
    const float empty = uniform(random), own = uniform(random);
    const float steps = format == GL_R8 ? 255.0F : 65535.0F;
    value = empty < emptyShare                    ? 0
            : format == GL_R8 || format == GL_R16 ? std::round(own * steps) / steps
            : format == GL_R16F                   ? host::roundedToHalf(own)
                                                  : own;
  }
  return values;
}

std::pair<glm::dvec3, glm::dvec3> texelRay(const tyndall::Light& light, int view, int size, int x, int y) {
  const glm::dmat4 worldFromClip =
      glm::inverse(reference::toMat4(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld));
  const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / static_cast<double>(size) * 2.0 - 1.0;
  std::array<double, 4> depth{};
  REQUIRE(tyndall::avsmDepth(light, view, depth));
  const auto pointAt = [&](double z) {
    const glm::dvec4 p = worldFromClip * glm::dvec4(place, z, 1);
    return glm::dvec3(p) / p.w;
  };
  std::pair<glm::dvec3, glm::dvec3> ray = {pointAt(-1), pointAt(1)};
  const auto depthAt = [&](const glm::dvec3& p) { return depth[0] * p.x + depth[1] * p.y + depth[2] * p.z + depth[3]; };
  if (depthAt(ray.first) > depthAt(ray.second)) std::swap(ray.first, ray.second);
  return ray;
}

double passedBy(const std::vector<Fog>& all, const std::pair<glm::dvec3, glm::dvec3>& ray, double depth,
                double lightDepth) {
  const glm::dvec3 along = ray.second - ray.first;
  double sum = 0;
  for (const Fog& fog : all)
    sum += reference::opticalDepth(fog.volume, fog.grid, ray.first + std::max(lightDepth, -10.0) * along,
                                   ray.first + depth * along);
  return std::exp(-sum);
}

} // namespace tests
