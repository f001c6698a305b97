// Every shader of the project as a complete source, in files whose names say the variant in words.
#pragma once

#include "gl/Variant.h"

#include <string>
#include <vector>

namespace tests {

struct ShaderFile {
  std::string name; ///< march-directional-one-view-grey.frag
  std::string text;
};

/// Those of the effect and of adaptive volumetric shadow maps, those of engines that include glsl/public, and those of
/// the baselines of tests/bench. No text is there twice.
std::vector<ShaderFile> allShaders();

/// Those of the effect as OpenGL ES is given them, with dual-source blending and without.
std::vector<ShaderFile> embeddedShaders();

/// How a file of that stem ("march") with these definitions is called, without extension.
std::string nameInWords(const std::string& stem, const tyndall::gl::Definitions& definitions);

} // namespace tests
