// Rows of StateGuard that contexts of the compatibility profile have besides: what is left of OpenGL 1 there and still
// changes what a program draws, or what is uploaded and read back. The rest of it (fog, texture environments, matrices,
// lighting, shading, client arrays) is not looked at while a program is in use.
#pragma once

#include "gl/Functions.h"

#include <array>
#include <vector>

namespace tyndall::gl {

/// Every function does nothing in other contexts.
class LegacyState {
public:
  explicit LegacyState(const Functions& gl) : gl_(gl) {}

  void save();          ///< and sets what a pass expects
  void restore() const; ///< after the stencil
  void setDefaults() const;

private:
  const Functions& gl_;
  std::vector<Enum> capabilities_; // that are on
  Int clamping_ = 0;
  std::array<Float, 9> transfer_{};
  Int stencilFace_ = 0;
};

} // namespace tyndall::gl
