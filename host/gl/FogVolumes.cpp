#include "gl/FogVolumes.h"

#include "gl/Gl.h"

#include <algorithm>
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

bool isFilledAlike(const FogBank& a, const FogBank& b) {
  return a.billows == b.billows && a.clear == b.clear && a.seed == b.seed;
}

/// No texture of an even bank.
GlTexture upload(const FogGrid& grid) {
  if (grid.size.x == 0) return {};
  GlTexture density = makeTexture();
  gl().BindTexture(GL_TEXTURE_3D, density.name());
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TexImage3D(GL_TEXTURE_3D, 0, GL_R8, grid.size.x, grid.size.y, grid.size.z, 0, GL_RED, GL_UNSIGNED_BYTE,
                  grid.values.data());
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl().BindTexture(GL_TEXTURE_3D, 0);
  return density;
}

} // namespace

void FogVolumes::set(const std::vector<FogBank>& banks) {
  const std::size_t known = std::min(banks_.size(), banks.size());
  banks_.resize(banks.size());
  for (std::size_t i = 0; i < banks.size(); ++i) {
    if (i >= known || !isFilledAlike(banks_[i].fog, banks[i])) {
      banks_[i].density = upload(fogGrid(banks[i]));
      banks_[i].version = ++uploads_;
    }
    banks_[i].fog = banks[i];
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
    volume.version = bank.version;
    volumes.push_back(volume);
  }
  return volumes;
}

} // namespace host
