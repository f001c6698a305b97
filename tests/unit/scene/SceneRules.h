// What holds of every scene that the loader lets pass, whatever its file was.
#pragma once

#include <scene/Scene.h>
#include <string>

namespace tests {

/// The first rule of scene/Scene.h that the scene breaks; empty if it keeps all.
std::string brokenRuleOf(const host::Scene& scene);

} // namespace tests
