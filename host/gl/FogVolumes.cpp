#include "gl/FogVolumes.h"

#include "gl/Gl.h"

#include <cmath>
#include <scene/Fog.h>
#include <scene/Projection.h>

namespace host {

namespace {

/// Of a cube that has lost an extent, but for rounding.
bool isFlat(glm::dmat3 axes) {
  constexpr double kRounding = 1e-9;
  for (int i = 0; i < 3; ++i) {
    const double length = glm::length(axes[i]);
    if (!(length > 0)) return true;
    axes[i] /= length;
  }
  return !(std::abs(glm::determinant(axes)) > kRounding);
}

} // namespace

FogVolumes::FogVolumes(const Scene& scene) {
  for (const FogBank& fog : scene.fog) {
    const FogGrid grid = fogGrid(fog);
    banks_.push_back({fog, {}});
    if (grid.size.x == 0) continue;
    banks_.back().density = makeTexture();
    gl().BindTexture(GL_TEXTURE_3D, banks_.back().density.name());
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl().TexImage3D(GL_TEXTURE_3D, 0, GL_R8, grid.size.x, grid.size.y, grid.size.z, 0, GL_RED, GL_UNSIGNED_BYTE,
                    grid.values.data());
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl().BindTexture(GL_TEXTURE_3D, 0);
  }
}

std::vector<tyndall::AvsmVolume> FogVolumes::at(const std::vector<glm::dmat4>& worldFromNode) const {
  std::vector<tyndall::AvsmVolume> volumes;
  for (const Bank& bank : banks_) {
    const glm::dmat4& matrix = worldFromNode[static_cast<std::size_t>(bank.fog.node)];
    if (isFlat(glm::dmat3(matrix))) continue;
    tyndall::AvsmVolume volume;
    volume.shape = bank.fog.sphere ? tyndall::AvsmVolume::Shape::Sphere : tyndall::AvsmVolume::Shape::Box;
    volume.worldFromVolume = toMat4(matrix);
    volume.extinction = bank.fog.extinction;
    volume.fade = bank.fog.fade;
    volume.density = bank.density.name();
    volume.version = 1; // it never changes
    volumes.push_back(volume);
  }
  return volumes;
}

} // namespace host
