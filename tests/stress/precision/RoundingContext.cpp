#include "RoundingContext.h"

#include "gl/Gl.h"
#include "support/TestContext.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace precision {

namespace {

using host::gl;

constexpr float kStandsForInfinity = 1e29F;

struct State {
  std::map<GLuint, Target> targets; // textures that have a name
  std::string lastFormat;           // of the texture that was made last
  std::map<Target, Rounding> roundings;
  std::map<Target, Seen> seen;
  bool watches = false;
};

State& state() { // a loader is a plain function
  static State theState;
  return theState;
}

struct FormatRow {
  GLint format;
  const char* name;
  GLint wide;
};
constexpr FormatRow kFormats[] = {{GL_R8, "R8", GL_R32F},
                                  {GL_RG16, "RG16", GL_RG32F},
                                  {GL_RGBA8, "RGBA8", GL_RGBA32F},
                                  {GL_RGBA16, "RGBA16", GL_RGBA32F},
                                  {GL_RGBA16F, "RGBA16F", GL_RGBA32F},
                                  {GL_R32F, "R32F", GL_R32F},
                                  {GL_RG32F, "RG32F", GL_RG32F},
                                  {GL_RGBA32F, "RGBA32F", GL_RGBA32F}};

// The format to make a texture in.
GLint widened(GLint format) {
  for (const FormatRow& row : kFormats)
    if (row.format == format) {
      state().lastFormat = row.name;
      return row.wide;
    }
  return format;
}

bool hasSteps(const std::string& format) { return format.back() != 'F'; }

GLenum channelsOf(GLint format) {
  return format == GL_R32F ? GL_RED : format == GL_RG32F ? GL_RG : format == GL_RGB32F ? GL_RGB : GL_RGBA;
}

int countOf(GLint format) { return format == GL_R32F ? 1 : format == GL_RG32F ? 2 : format == GL_RGB32F ? 3 : 4; }

void GLAD_API_PTR texImage2D(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                             GLenum channels, GLenum type, const void* pixels) {
  if (const GLint wide = widened(format); wide != format) {
    format = wide;
    channels = channelsOf(format);
    type = GL_FLOAT;
  }
  gl().TexImage2D(target, level, format, width, height, border, channels, type, pixels);
}

void GLAD_API_PTR texImage3D(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLsizei depth,
                             GLint border, GLenum channels, GLenum type, const void* pixels) {
  if (const GLint wide = widened(format); wide != format) {
    format = wide;
    channels = channelsOf(format);
    type = GL_FLOAT;
  }
  gl().TexImage3D(target, level, format, width, height, depth, border, channels, type, pixels);
}

void GLAD_API_PTR objectLabel(GLenum kind, GLuint name, GLsizei length, const GLchar* label) {
  constexpr std::string_view kOurs = "Tyndall ";
  if (kind == GL_TEXTURE && label)
    state().targets[name] = {std::string(label).substr(kOurs.size()), state().lastFormat};
  gl().ObjectLabel(kind, name, length, label);
}

// A texture's numbers, and back.
struct Texels {
  GLuint texture;
  GLint width = 0, height = 0, layers = 1, format = 0;
  std::vector<float> values;

  explicit Texels(GLuint name) : texture(name) {
    gl().GetTextureLevelParameteriv(name, 0, GL_TEXTURE_WIDTH, &width);
    gl().GetTextureLevelParameteriv(name, 0, GL_TEXTURE_HEIGHT, &height);
    gl().GetTextureLevelParameteriv(name, 0, GL_TEXTURE_DEPTH, &layers);
    gl().GetTextureLevelParameteriv(name, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    values.resize(static_cast<std::size_t>(width) * height * layers * countOf(format));
    gl().GetTextureImage(name, 0, channelsOf(format), GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                         values.data());
  }

  void write() const {
    GLint target = 0;
    gl().GetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
    if (target == GL_TEXTURE_2D_ARRAY)
      gl().TextureSubImage3D(texture, 0, 0, 0, 0, width, height, layers, channelsOf(format), GL_FLOAT, values.data());
    else
      gl().TextureSubImage2D(texture, 0, 0, 0, width, height, channelsOf(format), GL_FLOAT, values.data());
  }
};

Range rangeOf(const std::vector<float>& values, int channels, int channel) {
  Range range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (std::size_t i = static_cast<std::size_t>(channel); i < values.size(); i += static_cast<std::size_t>(channels))
    if (std::abs(values[i]) < kStandsForInfinity) {
      range.least = std::min(range.least, values[i]);
      range.greatest = std::max(range.greatest, values[i]);
    }
  return range;
}

void roundTexels(Texels& texels, const Rounding& rounding, bool isUnit) {
  const int channels = countOf(texels.format);
  const bool isStepped = rounding.format == Format::Unorm16 || rounding.format == Format::Unorm24;
  for (int c = 0; c < channels; ++c) {
    const Range range = isUnit ? Range{} : rangeOf(texels.values, channels, c);
    const Direction direction = !rounding.isBound ? rounding.direction : c % 2 == 0 ? Direction::Down : Direction::Up;
    for (std::size_t i = static_cast<std::size_t>(c); i < texels.values.size();
         i += static_cast<std::size_t>(channels)) {
      float& value = texels.values[i];
      if (!(isStepped && std::abs(value) >= kStandsForInfinity)) // which has a code of its own
        value = rounded(value, rounding.format, c, direction, range);
    }
  }
  texels.write();
}

void visit(GLuint texture) {
  const auto named = state().targets.find(texture);
  if (named == state().targets.end()) return;
  const auto found = state().roundings.find(named->second);
  const bool isRounded = found != state().roundings.end();
  if (!isRounded && !state().watches) return;
  Texels texels(texture);
  if (state().watches) {
    Seen& seen = state().seen[named->second];
    const Range range = rangeOf(texels.values, 1, 0);
    seen.least = seen.isAny ? std::min(seen.least, range.least) : range.least;
    seen.greatest = seen.isAny ? std::max(seen.greatest, range.greatest) : range.greatest;
    seen.isAny = true;
  }
  if (isRounded) roundTexels(texels, found->second, hasSteps(named->second.format));
}

// All that was drawn into.
void visitTargets() {
  if (state().roundings.empty() && !state().watches) return;
  GLint framebuffer = 0;
  gl().GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  if (framebuffer == 0) return;
  for (GLenum i = 0; i < 4; ++i) {
    GLint type = 0, name = 0;
    gl().GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i,
                                             GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type != GL_TEXTURE) continue;
    gl().GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i,
                                             GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    visit(static_cast<GLuint>(name));
  }
}

void GLAD_API_PTR drawArrays(GLenum mode, GLint first, GLsizei count) {
  gl().DrawArrays(mode, first, count);
  visitTargets();
}

void GLAD_API_PTR drawArraysInstanced(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
  gl().DrawArraysInstanced(mode, first, count, instances);
  visitTargets();
}

void GLAD_API_PTR blitFramebuffer(GLint x0, GLint y0, GLint x1, GLint y1, GLint toX0, GLint toY0, GLint toX1,
                                  GLint toY1, GLbitfield mask, GLenum filter) {
  gl().BlitFramebuffer(x0, y0, x1, y1, toX0, toY0, toX1, toY1, mask, filter);
  visitTargets();
}

void GLAD_API_PTR texSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width, GLsizei height,
                                GLenum channels, GLenum type, const void* pixels) {
  gl().TexSubImage2D(target, level, x, y, width, height, channels, type, pixels);
  GLint name = 0;
  gl().GetIntegerv(GL_TEXTURE_BINDING_2D, &name);
  visit(static_cast<GLuint>(name));
}

// Rows of a sun are rounded to 16 bits by the shader that makes them: not here.
void GLAD_API_PTR shaderSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths) {
  constexpr std::string_view kRounds = "rowCodeSteps > 0.0";
  std::string text;
  for (GLsizei i = 0; i < count; ++i)
    text += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i];
  for (std::size_t at = text.find(kRounds); at != std::string::npos; at = text.find(kRounds, at))
    text.replace(at, kRounds.size(), "false");
  const GLchar* one = text.c_str();
  gl().ShaderSource(shader, 1, &one, nullptr);
}

void* roundingLoader(const char* name) {
  const std::map<std::string_view, void*> own = {
      {"glTexImage2D", reinterpret_cast<void*>(texImage2D)},
      {"glTexImage3D", reinterpret_cast<void*>(texImage3D)},
      {"glObjectLabel", reinterpret_cast<void*>(objectLabel)},
      {"glDrawArrays", reinterpret_cast<void*>(drawArrays)},
      {"glDrawArraysInstanced", reinterpret_cast<void*>(drawArraysInstanced)},
      {"glBlitFramebuffer", reinterpret_cast<void*>(blitFramebuffer)},
      {"glTexSubImage2D", reinterpret_cast<void*>(texSubImage2D)},
      {"glShaderSource", reinterpret_cast<void*>(shaderSource)},
  };
  const auto found = own.find(name);
  return found != own.end() ? found->second : tests::testContext().loader()(name);
}

} // namespace

RoundingContext::RoundingContext() {
  tests::testContext();
  state() = {};
}
RoundingContext::~RoundingContext() { state() = {}; }

tyndall::GlLoader RoundingContext::loader() const { return roundingLoader; }
void RoundingContext::round(const std::map<Target, Rounding>& targets) { state().roundings = targets; }
void RoundingContext::watch(bool on) { state().watches = on; }
std::map<Target, Seen> RoundingContext::takeSeen() { return std::exchange(state().seen, {}); }

} // namespace precision
