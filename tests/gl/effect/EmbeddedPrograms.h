// The effect's programs as OpenGL ES is given them, built in the current context.
#pragma once

#include <string>
#include <vector>

namespace tests {

struct BuiltPrograms {
  int count = 0;                     ///< that were asked for
  std::vector<std::string> failures; ///< names, and what the driver says
};

/// Builds a set of programs, with dual-source blending and without, in which every two definitions that any program of
/// a shader has together are together in one of that shader's: under half of all of them, which tell what all would but
/// for what only three make together.
BuiltPrograms buildEmbeddedPairs();

} // namespace tests
