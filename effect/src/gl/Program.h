// A linked program that is ready to draw.
#pragma once

#include "gl/Objects.h"

#include <string>
#include <vector>

namespace tyndall::gl {

/// Its samplers' units and its blocks' bindings are set.
class Program {
public:
  /// An active sampler uniform.
  struct Sampler {
    std::string name;
    Enum target; ///< TEXTURE_2D, TEXTURE_2D_ARRAY or TEXTURE_2D_MULTISAMPLE
    Uint unit;
  };

  /// Takes over a program that is linked. Leaves it in use.
  Program(const Functions& gl, ProgramObject program);

  Uint name() const { return program_.name(); }
  /// In the order of their units.
  const std::vector<Sampler>& samplers() const { return samplers_; }

private:
  void findSamplers(const Functions& gl);
  void bindBlocks(const Functions& gl) const;

  ProgramObject program_;
  std::vector<Sampler> samplers_;
};

} // namespace tyndall::gl
