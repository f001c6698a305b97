// A scene's banks of fog as the effect captures them (tyndall::Avsm::drawVolumes).
#pragma once

#include "gl/Objects.h"

#include <scene/Scene.h>
#include <tyndall/avsm.h>
#include <vector>

namespace host {

class FogVolumes {
public:
  /// Uploads their densities, but of those that are filled as they were.
  void set(const std::vector<FogBank>& banks);

  /// In a pose; those whose nodes have lost an extent are left out. Textures live as long as this.
  std::vector<tyndall::AvsmVolume> at(const std::vector<glm::dmat4>& worldFromNode) const;

private:
  struct Bank {
    FogBank fog;
    GlTexture density; ///< none of an even bank
    std::uint64_t version = 0;
  };
  std::vector<Bank> banks_;
  std::uint64_t uploads_ = 0;
};

} // namespace host
