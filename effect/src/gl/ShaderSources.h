// The shaders embedded at build time (effect/cmake/EmbedShaders.cmake).
#pragma once

namespace tyndall {

/// The text of a file of glsl/, includes resolved, without #version; null for an unknown name.
const char* shaderSource(const char* name);

} // namespace tyndall
