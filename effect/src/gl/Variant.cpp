#include "gl/Variant.h"

#include "gl/ShaderSources.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace tyndall::gl {

namespace {

bool continuesWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool mentions(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !continuesWord(text[at - 1]);
    if (begins && (end == text.size() || !continuesWord(text[end]))) return true;
  }
  return false;
}

bool isCompute(const std::string& file) { return file.size() > 5 && file.substr(file.size() - 5) == ".comp"; }

// ESSL knows two precisions where GLSL has one, and dual-source blending, if at all, as an extension.
constexpr const char* kEssl = R"(#version 320 es
#extension GL_EXT_blend_func_extended : enable
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DMS;
precision highp sampler2DMSArray;
precision highp samplerCube;
precision highp samplerCubeArray;
precision highp usampler2DArray;
)";

std::string prologueOf(const std::string& file, Language language) {
  if (language == Language::Essl) return kEssl;
  return isCompute(file) ? "#version 430 core\n" : "#version 330 core\n";
}

} // namespace

Definitions mentionedBy(const std::string& text, const Definitions& definitions) {
  Definitions result;
  std::copy_if(definitions.begin(), definitions.end(), std::back_inserter(result),
               [&](const auto& definition) { return mentions(text, definition.first); });
  return result;
}

Definitions mentioned(const Variant& variant) {
  std::string text = shaderSource(variant.fragment);
  if (!variant.vertex.empty()) text += shaderSource(variant.vertex);
  return mentionedBy(text, variant.definitions);
}

std::string completeSource(const std::string& file, const Definitions& definitions, Language language) {
  const std::string body = shaderSource(file);
  std::string text = prologueOf(file, language);
  text += "#define UNIFORM_BLOCK(name) layout(std140) uniform name\n";
  for (const auto& [name, value] : mentionedBy(body, definitions))
    text += "#define " + name + " " + std::to_string(value) + "\n";
  return text + body;
}

std::string keyOf(const Variant& variant) {
  std::string key = variant.fragment;
  if (!variant.vertex.empty() && variant.vertex != kFullScreen) key += " " + variant.vertex;
  for (const auto& [name, value] : variant.definitions)
    key += " " + name + "=" + std::to_string(value);
  return key;
}

} // namespace tyndall::gl
