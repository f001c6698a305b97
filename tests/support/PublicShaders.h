// Shaders of engines that include what glsl/public has: every set of definitions, in each kind of shader that it is
// for.
#pragma once

#include <string>
#include <vector>

namespace tests {

struct PublicShader {
  std::string name;      ///< says the definitions in words
  std::string extension; ///< vert, frag, comp
  std::string text;      ///< complete
  int version;           ///< of OpenGL that it needs, 33 or more
  std::string needs;     ///< an extension; empty: none
};

std::vector<PublicShader> captureShaders();
std::vector<PublicShader> insertShaders();
std::vector<PublicShader> lookupShaders();
std::vector<PublicShader> shaftsLookupShaders();

} // namespace tests
