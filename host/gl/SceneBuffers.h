// A scene's meshes and textures on the GPU, and the list of what there is to draw.
#pragma once

#include "gl/Objects.h"
#include "scene/Scene.h"

namespace host {

/// How a surface takes part in shadows and in the picture.
enum class SurfaceClass {
  Opaque,
  Masked,  ///< cut out by alpha
  Blended, ///< drawn over what is behind it; lets 1 - alpha of the light through
  Glass,   ///< tints what is behind it and casts no shadow
};
SurfaceClass classOf(const Material& material);

class SceneBuffers {
public:
  explicit SceneBuffers(const Scene& scene);

  struct Primitive {
    GlVertexArray vertexArray;
    GlBuffer vertices;
    GlBuffer indices;
    GLenum mode = GL_TRIANGLES;
    GLsizei count = 0;
    int material = 0;
    glm::dvec3 low{0}; ///< bounds of its vertices
    glm::dvec3 high{0};
  };

  /// A primitive at a node.
  struct Draw {
    const Primitive* primitive = nullptr;
    int node = 0;
    SurfaceClass surface = SurfaceClass::Opaque;
    bool casts = true; ///< a shadow or a tint: not if unlit

    bool tintsLight() const { return casts && (surface == SurfaceClass::Glass || surface == SurfaceClass::Blended); }
  };

  /// By material, so that neighbours share their textures. Without lines, which are strands (gl/StrandRenderer.h).
  const std::vector<Draw>& draws() const { return draws_; }
  const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }
  GLuint textureOf(const Material& material) const; ///< white for a material without texture

  /// Draws with the program in use.
  static void submit(const Primitive& primitive);
  /// Whether the bounds lie wholly beyond one of the side planes of a view.
  static bool isBesideView(const Primitive& primitive, const glm::dmat4& clipFromNode);

  /// Throws host::Error unless there is a matrix for each node.
  void requirePose(const std::vector<glm::dmat4>& worldFromNode) const;
  bool hasGlass() const { return hasGlass_; } ///< or anything else that tints light

private:
  std::vector<std::vector<Primitive>> meshes_;
  std::vector<Draw> draws_;
  std::vector<Material> materials_;
  std::vector<GlTexture> textures_;
  GlTexture white_;
  std::size_t nodeCount_ = 0;
  bool hasGlass_ = false;
};

} // namespace host
