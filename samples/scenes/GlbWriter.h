// Writes a scene as a binary glTF 2.0 file.
#pragma once

#include "Scene.h"
#include <string>

namespace scenes {

/// Throws host::Error where the file can't be written; nothing half-written stays behind.
void writeGlb(const Scene& scene, const std::string& path);

} // namespace scenes
