// Shaders of the benchmarks with their includes in place: from this folder, from that of the rivals of adaptive
// volumetric shadow maps, or from the effect's glsl/.
#pragma once

#include <string>
#include <vector>

namespace bench {

/// Begins with #version and the block macro of glsl/shared.glsl. Throws host::Error if a file is missing.
std::string shaderText(const std::string& file);

/// The files one after the other and nothing else, what several include once.
std::string shaderBody(const std::vector<std::string>& files);

} // namespace bench
