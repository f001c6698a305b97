// From a checked document to the host's scene, a part each. All refuse what leaves geometry, camera or light undefined.
#pragma once

#include "Document.h"

#include <scene/Scene.h>

namespace host::gltf {

/// How a material's base-colour texture takes its coordinates: set `texCoord`, uv' = offset + linear uv.
struct TextureCoordinates {
  bool needed = false;
  int texCoord = 0;
  glm::vec2 offset{0};
  glm::mat2 linear{1};
};

/// Fills scene.materials and scene.textures; the last material is glTF's default one, for primitives without any.
std::vector<TextureCoordinates> convertMaterials(Document& document, Scene& scene);

/// Fills scene.meshes, one for each of the file's.
void convertMeshes(Document& document, const std::vector<TextureCoordinates>& coordinates, Scene& scene);

void convertCameras(Document& document, Scene& scene);
void convertLights(Document& document, Scene& scene);

/// Fills scene.nodes, parents first, with the nodes of the file's scene. Returns for each of the file's nodes its index
/// in scene.nodes, or -1. Refuses loops and nodes with two parents.
std::vector<int> convertNodes(Document& document, Scene& scene);

/// Fills scene.animation.
void convertAnimations(Document& document, const std::vector<int>& sceneNodes, Scene& scene);

} // namespace host::gltf
