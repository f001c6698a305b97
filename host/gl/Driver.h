// What a driver's name says.
#pragma once

#include <string>

namespace host {

/// Whether a renderer, or a text that holds its name as Context::driver() does, is a software rasteriser.
bool isSoftware(const std::string& renderer);

} // namespace host
