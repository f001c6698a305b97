// A look-up as an engine has it (Frame::lookup): its textures, and what a surface's shader makes of them.
#pragma once

#include <gl/Objects.h>
#include <reference/Ray.h>
#include <tyndall/tyndall.h>

namespace tests {

class ShaftsLookup {
public:
  struct Range {
    double near, far;
  };
  ShaftsLookup(int columns, int rows, int layerCount, const Range& distances, GLenum format = GL_RGBA32F);

  void enter(tyndall::Frame& frame) const;

  double distance(int layer) const; ///< of a layer
  reference::Image light(int layer) const;
  reference::Image passed(int layer) const;

  /// Inscatter and transmittance of a surface at a distance, all over a viewport of that size at (0, 0).
  reference::ImageAnswer at(double distance, int viewportWidth, int viewportHeight) const;

private:
  int width_, height_, depths_;
  Range range_;
  host::GlTexture inscatter_, transmittance_;
};

} // namespace tests
