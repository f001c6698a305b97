// The structure of a glTF document, checked before the converters rely on it: types, required
// members, indices, and the ranges of buffer views and accessors. Values (camera angles, vertex data) are checked by
// those who convert them.
#pragma once

#include "Document.h"

namespace host::gltf {

/// Refuses what would leave geometry, camera or light undefined. Rewrites whole numbers as integers.
void check(Document& document);

/// Its parts: asset and extensions; buffers, views and accessors; meshes, nodes, scenes, cameras, lights, animations;
/// materials and textures.
void checkAsset(Document& document);
void checkAccessors(Document& document);
void checkGraph(Document& document);
void checkMaterials(Document& document);

} // namespace host::gltf
