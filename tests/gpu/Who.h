// Who draws: the driver, its limits and extensions, and the machine.
#pragma once

#include <nlohmann/json.hpp>

namespace gpu {

using Json = nlohmann::ordered_json;

/// Opens a context by EGL. Throws host::Error if there is none, or none of OpenGL 4.3.
Json who();

} // namespace gpu
