// Depth conventions and a small camera for the tests of the references.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <reference/MapExact.h>
#include <tyndall/tyndall.h>

namespace tests {

inline constexpr int kWidth = 24, kHeight = 16;

struct Convention {
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
  bool reversed = false;

  /// From GL's default clip space to this convention's.
  glm::dmat4 convert() const {
    glm::dmat4 m(1);
    const bool half = clipDepth == tyndall::ClipDepth::ZeroToOne;
    m[2][2] = (half ? 0.5 : 1.0) * (reversed ? -1 : 1);
    m[3][2] = half ? 0.5 : 0;
    return m;
  }
  float depth(double standard) const { return static_cast<float>(reversed ? 1 - standard : standard); }
};

inline const Convention kConventions[] = {{tyndall::ClipDepth::NegativeOneToOne, false},
                                          {tyndall::ClipDepth::NegativeOneToOne, true},
                                          {tyndall::ClipDepth::ZeroToOne, false},
                                          {tyndall::ClipDepth::ZeroToOne, true}};

inline tyndall::Mat4 toTyndall(const glm::dmat4& m) {
  tyndall::Mat4 result{};
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = m[static_cast<int>(i / 4)][static_cast<int>(i % 4)];
  return result;
}

/// Looks along -z from (0.3, 1.5, 12), a little down; nothing in front of it but the sky.
inline reference::MapScene emptyScene(const Convention& convention = {}) {
  reference::MapScene scene;
  scene.width = kWidth;
  scene.height = kHeight;
  scene.camera.viewFromWorld =
      toTyndall(glm::lookAt(glm::dvec3(0.3, 1.5, 12), glm::dvec3(0.1, 1, 0), glm::dvec3(0, 1, 0)));
  scene.camera.clipFromView = toTyndall(convention.convert() * glm::perspective(0.8, 1.5, 0.1, 100.0));
  scene.camera.clipDepth = convention.clipDepth;
  scene.medium.constituents = {{{0.04F, 0.06F, 0.1F}, tyndall::Phase::HenyeyGreenstein, 0.4F}};
  scene.medium.absorption = {0.01F, 0.02F, 0.0F};
  scene.depth.assign(kWidth * kHeight, convention.depth(1));
  return scene;
}

} // namespace tests
