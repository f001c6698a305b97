// What selects a program: its shaders and definitions, and the texts that GL is given for them.
#pragma once

#include "gl/Functions.h"

#include <string>
#include <utility>
#include <vector>

namespace tyndall::gl {

using Definitions = std::vector<std::pair<std::string, int>>; ///< name and value of each #define

inline constexpr const char* kFullScreen = "passes/fullscreen.vert";

struct Variant {
  std::string fragment; ///< or compute shader
  Definitions definitions;
  std::string vertex = kFullScreen; ///< empty for a compute shader
};

/// Those definitions that a shader's text mentions, as whole words.
Definitions mentionedBy(const std::string& text, const Definitions& definitions);

/// Those that a variant's shaders mention: variants that differ in no other are one program.
Definitions mentioned(const Variant& variant);

/// The complete text of a shader as GL is given it, with those of the definitions that it mentions.
std::string completeSource(const std::string& file, const Definitions& definitions, Language language = Language::Glsl);

/// Its name in errors and debuggers, another for each: files and definitions; the full-screen vertex shader goes
/// unsaid.
std::string keyOf(const Variant& variant);

} // namespace tyndall::gl
