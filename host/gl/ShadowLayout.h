// Shadow maps and glass maps as renderers keep them: from an array, a layer a view, into an atlas or a cube map, as
// window depth or as distances.
#pragma once

#include "gl/MapForm.h"
#include "gl/Objects.h"

namespace host {

/// The textures of one light.
struct LaidOutMaps {
  GlTexture depth;       ///< GL_R32F
  GlTexture glassColour; ///< GL_RGBA16F; none without glass
  GlTexture glassDepth;  ///< GL_R32F; none without glass
};

class ShadowLayout {
public:
  explicit ShadowLayout(const MapForm& form);

  /// From the light's maps, arrays of `size` texels a side with its views in layers 0, 1, ..., makes those of the form,
  /// and enters them into the light. A cube map's views must be those of ShadowOptions::cubeFaces.
  LaidOutMaps layOut(tyndall::Light& light, int size);

private:
  struct Target;
  void copy(const tyndall::Light& light, GLuint from, const GlTexture& to, bool isDepth, const Target& target);

  void enter(tyndall::Light& light, const Target& target) const;

  MapForm form_;
  Program program_;
  GlFramebuffer framebuffer_;
  GlVertexArray empty_;
};

} // namespace host
