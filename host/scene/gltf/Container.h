// The outermost layer: the bytes of a .glb or .gltf file, split into JSON and binary chunk.
#pragma once

#include "Document.h"

namespace host::gltf {

/// Reads the document's file, a GLB if it begins with that magic, and sets json and binaryChunk. Checks all lengths
/// against the file's, and bounds the size and depth of the JSON.
void readContainer(Document& document);

} // namespace host::gltf
