// Strips, fans and loops as lists, and normals where a file has none.
#pragma once

#include <scene/Scene.h>

namespace host::gltf {

/// glTF's primitive modes, which are GL's.
enum class Mode { Points, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

Topology topologyOf(Mode mode);

/// The indices of separate points, lines or triangles, wound as glTF 2.0 section 3.7.2.1 says. What is incomplete at
/// the end is left out.
std::vector<std::uint32_t> unroll(Mode mode, const std::vector<std::uint32_t>& indices);

/// Whether `count` indices make whole points, lines or triangles.
bool isComplete(Mode mode, std::size_t count);

/// Gives each triangle vertices of its own and its flat normal.
void makeFlat(Primitive& triangles);

/// Replaces zero normals by the area-weighted mean of the triangles around. Returns whether there were any.
bool repairNormals(Primitive& triangles);

} // namespace host::gltf
