// glTF 2.0 files (.glb, .gltf) as a host::Scene.
#pragma once

#include <filesystem>
#include <functional>
#include <scene/Scene.h>

namespace host {

/// Reads a glTF 2.0 file and all that it refers to. Of several scenes the default one is taken, else the first, else
/// all root nodes. What would leave geometry, camera or light undefined throws Error with one line that names file,
/// JSON path and rule; cosmetic defects (a missing texture, an unknown material extension) become Scene::notes.
/// Buffers, images and unrolled geometry are bounded, so that a broken file can neither hang the loader nor fill
/// memory.
Scene loadScene(const std::filesystem::path& file);

/// What is being done, and the share that is done before it. What it throws ends the loading.
using LoadWatch = std::function<void(const char* stage, double share)>;
Scene loadScene(const std::filesystem::path& file, const LoadWatch& watch);

} // namespace host
