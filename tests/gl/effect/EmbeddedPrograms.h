// The effect's programs as OpenGL ES is given them.
#pragma once

#include <string>
#include <vector>

namespace tests {

struct ProgramText {
  std::string name, vertex, fragment;
};

/// Programs, with dual-source blending and without, of which every two definitions that any program of a shader has
/// together are together in one of that shader's: under half of all of them, which tell what all would but for what
/// only three make together.
std::vector<ProgramText> embeddedPairs();

} // namespace tests
