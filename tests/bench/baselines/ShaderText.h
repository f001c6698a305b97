// Shaders of the baselines with their includes in place: from this folder or from the effect's glsl/.
#pragma once

#include <string>

namespace bench {

/// Begins with #version and the block macro of glsl/shared.glsl. Throws host::Error if a file is missing.
std::string shaderText(const std::string& file);

} // namespace bench
