// All that the parts of a run left, in one text of JSON.
#pragma once

#include "Who.h"

#include <filesystem>

namespace gpu {

/// Of the folder's parts/: a folder for each step, with its status.json and what its tool wrote. What is missing or
/// damaged is left out, and said in the step's row. Throws host::Error if not even who.json can be read.
Json reportOf(const std::filesystem::path& folder);

} // namespace gpu
