// The shaders embedded at build time (effect/cmake/EmbedShaders.cmake).
#pragma once

#include <string>

namespace tyndall {

/// The text of a file of glsl/, includes resolved, without #version; empty for an unknown name.
std::string shaderSource(const std::string& name);

} // namespace tyndall
