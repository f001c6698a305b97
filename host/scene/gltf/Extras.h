// What glTF has no words for, in extras.tyndall of nodes, materials and primitives: smoke, fog and strands.
#pragma once

#include "Document.h"

#include <scene/Scene.h>

namespace host::gltf {

/// Fills scene.smoke from {"smoke": {...}} of the nodes. sceneNodes: as convertNodes() returns it.
void convertSmoke(Document& document, const std::vector<int>& sceneNodes, Scene& scene);

/// Fills scene.fog from {"fog": {...}} of the nodes, after convertSmoke().
void convertFog(Document& document, const std::vector<int>& sceneNodes, Scene& scene);

/// What lines look like: {"strand": {"width": w, "opacity": o}} of the primitive or else of its material, and what both
/// leave open by defaultStrand(). `mesh`, `primitive`: indices of the file.
Strand strandOf(Document& document, std::size_t mesh, std::size_t primitive, const Primitive& lines);

} // namespace host::gltf
