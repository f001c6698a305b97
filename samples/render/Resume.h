// What of an animation has been drawn.
#pragma once

#include "Options.h"

#include <string>
#include <vector>

namespace render {

/// The share's frames of which a picture is not there or not whole.
std::vector<int> missingFrames(const Options& options);

/// "3-7,12": ascending numbers, with runs of them drawn together.
std::string rangesOf(const std::vector<int>& frames);

} // namespace render
