// A sequence that fails, made as small as it can be and still fail.
#pragma once

#include "Recipe.h"

#include <functional>
#include <optional>
#include <string>

namespace stress {

/// Runs a sequence: what is wrong with it, "frame 7: ..." with the frame of that number, or none.
using Run = std::function<std::optional<std::string>(const Recipe&)>;

/// No frame after the one that fails, no ingredient and no frame before it that it can do without.
Recipe shrunk(const Recipe& recipe, const std::string& trouble, const Run& run);

/// The frame that a trouble names; -1 if it names none.
int frameOf(const std::string& trouble);

} // namespace stress
