// Light along one ray as a light's shadow views let it through.
#pragma once

#include "MapExact.h"
#include "Optics.h"

namespace reference {

/// A shadow view made ready: matrix in double, depth direction found.
struct PreparedView {
  glm::dmat4 clipFromWorld{1};
  bool reversed = false;
  bool hasFarPlane = false; ///< what lies beyond the far plane belongs to a later cascade
  std::size_t offset = 0;   ///< first texel of the layer
};

/// A light's shadow views over its maps; the image must outlive it.
struct PreparedLight {
  const ShadowImage* image = nullptr;
  tyndall::ShadowFilter filter = tyndall::ShadowFilter::Nearest;
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
  bool litOutsideViews = true;
  double fade = 0; ///< share of a view's width over which it fades into the next
  bool hasGlass = false;
  std::vector<PreparedView> views; ///< none: nothing blocks the light
};

PreparedLight prepareLight(const tyndall::Light& light, const ShadowImage& image, tyndall::ShadowFilter filter);

/// The light's in-scattered radiance from [s0, s1] of the ray that the airlight was made for.
Rgb shadowedInscatter(const PreparedLight& light, const Airlight& airlight, const Ray& ray, double s0, double s1);

} // namespace reference
