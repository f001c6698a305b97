#include "InspectTexture.h"

#include "CheckFrame.h"
#include "FieldText.h"
#include "gl/OwnErrors.h"

#include <array>
#include <cstddef>
#include <utility>

namespace tyndall {

using namespace gl; // GL's enumerants

Status invalid(const std::string& field, Uint name, const std::string& rule) {
  return {StatusCode::InvalidFrame, "Frame::" + field + " is texture " + std::to_string(name) + ": " + rule};
}

bool isFloatColour(Int format) {
  switch (static_cast<Enum>(format)) {
  case RGB16F:
  case RGBA16F:
  case RGB32F:
  case RGBA32F:
  case R11F_G11F_B10F:
    return true;
  default:
    return false;
  }
}

bool isFixedPoint(Int format) {
  const auto f = static_cast<Enum>(format);
  return f == DEPTH_COMPONENT || f == DEPTH_COMPONENT16 || f == DEPTH_COMPONENT24 || f == DEPTH_COMPONENT32 ||
         f == DEPTH24_STENCIL8;
}

bool isOneChannel(Int format) {
  const auto f = static_cast<Enum>(format);
  return f == R8 || f == R16 || f == R16F || f == R32F;
}

// Contexts that know no other way say by an error that it is not.
bool bindIfOf(const Functions& gl, Uint name, Enum target) {
  Int its = 0;
  if (gl.GetTextureParameteriv) {
    gl.GetTextureParameteriv(name, TEXTURE_TARGET, &its);
    if (static_cast<Enum>(its) == target) gl.BindTexture(target, name);
    return static_cast<Enum>(its) == target;
  }
  OwnErrors errors(gl);
  gl.BindTexture(target, name);
  return errors.take() == NO_ERROR;
}

float largestValue(Int format) {
  switch (static_cast<Enum>(format)) {
  case RGB32F:
  case RGBA32F:
    return kLargestFloat;
  case R11F_G11F_B10F:
    return 64512; // of its 10-bit blue
  default:
    return 65504;
  }
}

float roundingOf(Int format) {
  switch (static_cast<Enum>(format)) {
  case R16F:
    return 5e-4F;
  case DEPTH_COMPONENT16:
    return 2e-5F;
  default:
    return 1e-6F;
  }
}

namespace {

const char* targetName(Enum target) {
  return target == TEXTURE_2D               ? "GL_TEXTURE_2D"
         : target == TEXTURE_2D_ARRAY       ? "GL_TEXTURE_2D_ARRAY"
         : target == TEXTURE_2D_MULTISAMPLE ? "GL_TEXTURE_2D_MULTISAMPLE"
         : target == TEXTURE_CUBE_MAP       ? "GL_TEXTURE_CUBE_MAP"
         : target == TEXTURE_CUBE_MAP_ARRAY ? "GL_TEXTURE_CUBE_MAP_ARRAY"
                                            : "GL_TEXTURE_2D_MULTISAMPLE_ARRAY";
}

bool isMultisample(Enum target) { return target == TEXTURE_2D_MULTISAMPLE || target == TEXTURE_2D_MULTISAMPLE_ARRAY; }
bool isArray(Enum target) {
  return target == TEXTURE_2D_ARRAY || target == TEXTURE_CUBE_MAP_ARRAY || target == TEXTURE_2D_MULTISAMPLE_ARRAY;
}

bool isDepthFormat(Int format) {
  switch (static_cast<Enum>(format)) {
  case DEPTH_COMPONENT:
  case DEPTH_COMPONENT16:
  case DEPTH_COMPONENT24:
  case DEPTH_COMPONENT32:
  case DEPTH_COMPONENT32F:
  case DEPTH24_STENCIL8:
  case DEPTH32F_STENCIL8:
  case R32F:
    return true;
  default:
    return false;
  }
}

bool isTint(Int format) {
  switch (static_cast<Enum>(format)) {
  case RGB8:
  case RGBA8:
  case SRGB8:
  case SRGB8_ALPHA8:
    return true;
  default:
    return isFloatColour(format);
  }
}

// Of the bound texture; of a cube map's, of one face.
TextureInfo levelOf(const Functions& gl, Enum target) {
  TextureInfo info;
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_WIDTH, &info.width);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_HEIGHT, &info.height);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_INTERNAL_FORMAT, &info.format);
  return info;
}

// GL samples none of a cube map whose faces differ.
Status checkFaces(const Functions& gl, const std::string& field, Uint name, const TextureInfo& first) {
  constexpr std::array<const char*, 6> kFaces = {"POSITIVE_X", "NEGATIVE_X", "POSITIVE_Y",
                                                 "NEGATIVE_Y", "POSITIVE_Z", "NEGATIVE_Z"};
  for (Uint i = 0; i < kFaces.size(); ++i) {
    const TextureInfo face = levelOf(gl, TEXTURE_CUBE_MAP_POSITIVE_X + i);
    const std::string its = std::string("its face GL_TEXTURE_CUBE_MAP_") + kFaces[i];
    if (face.width < 1) return invalid(field, name, its + " has no level 0");
    if (face.width != first.width || face.height != first.height || face.format != first.format)
      return invalid(field, name, its + " must have the size and format of the others");
  }
  return {};
}

// Leaves the texture bound.
Status inspect(const Functions& gl, const std::string& field, Uint name, Enum target, TextureInfo& info) {
  if (!gl.IsTexture(name))
    return invalid(field, name, "not the name of a texture in this context (deleted, or never bound?)");
  if (!bindIfOf(gl, name, target)) return invalid(field, name, std::string("must be a ") + targetName(target));
  info = levelOf(gl, target == TEXTURE_CUBE_MAP ? TEXTURE_CUBE_MAP_POSITIVE_X : target);
  if (isArray(target)) gl.GetTexLevelParameteriv(target, 0, TEXTURE_DEPTH, &info.layers);
  if (isMultisample(target)) gl.GetTexLevelParameteriv(target, 0, TEXTURE_SAMPLES, &info.samples);
  if (target == TEXTURE_CUBE_MAP)
    if (Status s = checkFaces(gl, field, name, info); !s) return s;
  if (info.width < 1) return invalid(field, name, "has no level 0");
  if (!isMultisample(target)) {
    Int base = 0;
    gl.GetTexParameteriv(target, TEXTURE_BASE_LEVEL, &base);
    if (base != 0) return invalid(field, name, "GL_TEXTURE_BASE_LEVEL must be 0");
  }
  return {};
}

Status checkFormat(const std::string& field, Uint name, Use use, Int format) {
  if (use == Use::Map && !isDepthFormat(format) && static_cast<Enum>(format) != R16F &&
      static_cast<Enum>(format) != RG32F)
    return invalid(field, name, "must have a depth format, R16F, R32F or RG32F");
  if (use == Use::Depth && !isDepthFormat(format)) return invalid(field, name, "must have a depth format or R32F");
  if ((use == Use::Colour || use == Use::Output) && !isFloatColour(format))
    return invalid(field, name, "must have a float colour format (RGBA16F, RGBA32F, R11F_G11F_B10F, RGB16F, RGB32F)");
  if (use == Use::Tint && !isTint(format))
    return invalid(field, name, "must have an RGB or RGBA format of 8 bits or floats");
  if (use == Use::Occlusion && !isOneChannel(format))
    return invalid(field, name, "must have the format R8, R16, R16F or R32F");
  if (use == Use::Curves && static_cast<Enum>(format) != RGBA32UI)
    return invalid(field, name, "must be what Avsm::curves() gave: RGBA32UI");
  return {};
}

// How many channels of a texture are read as they are stored. No sampler can undo what the texture's own parameters do
// to them; a tint may come in any order.
std::size_t channelsRead(Use use) {
  return use == Use::Depth || use == Use::Map || use == Use::Occlusion ? 1
         : use == Use::Output                                          ? 3
         : use == Use::Curves                                          ? 4
                                                                       : 0;
}

// The texture is bound. OpenGL ES tells one channel at a time.
void readSwizzle(const Functions& gl, Enum target, std::array<Int, 4>& sources) {
  if (gl.language == Language::Glsl) return gl.GetTexParameteriv(target, TEXTURE_SWIZZLE_RGBA, sources.data());
  for (Enum channel = 0; channel < 4; ++channel)
    gl.GetTexParameteriv(target, TEXTURE_SWIZZLE_R + channel, &sources[channel]);
}

// The texture is bound.
Status checkChannels(const Functions& gl, const std::string& field, Uint name, Enum target, Use use) {
  constexpr std::array<std::pair<Enum, const char*>, 4> kOwn = {{{RED, "R must be GL_RED"},
                                                                 {GREEN, "G must be GL_GREEN"},
                                                                 {BLUE, "B must be GL_BLUE"},
                                                                 {ALPHA, "A must be GL_ALPHA"}}};
  std::array<Int, 4> sources = {RED, GREEN, BLUE, ALPHA};
  if (channelsRead(use) > 0) readSwizzle(gl, target, sources);
  for (std::size_t i = 0; i < channelsRead(use); ++i) {
    if (static_cast<Enum>(sources[i]) != kOwn[i].first)
      return invalid(field, name, std::string("GL_TEXTURE_SWIZZLE_") + kOwn[i].second);
  }
  if (use != Use::Depth && use != Use::Map) return {};
  Int mode = DEPTH_COMPONENT;
  if (gl.stencilTexturing) gl.GetTexParameteriv(target, DEPTH_STENCIL_TEXTURE_MODE, &mode);
  if (static_cast<Enum>(mode) != DEPTH_COMPONENT)
    return invalid(field, name, "GL_DEPTH_STENCIL_TEXTURE_MODE must be GL_DEPTH_COMPONENT");
  mode = RED;
  if (gl.compatibility) gl.GetTexParameteriv(target, DEPTH_TEXTURE_MODE, &mode);
  if (static_cast<Enum>(mode) == ALPHA) return invalid(field, name, "GL_DEPTH_TEXTURE_MODE must not be GL_ALPHA");
  return {};
}

} // namespace

Status checkTexture(const Functions& gl, const std::string& field, Uint name, Enum target, Use use, TextureInfo& info) {
  if (Status s = inspect(gl, field, name, target, info); !s) return s;
  if (Status s = checkFormat(field, name, use, info.format); !s) return s;
  return checkChannels(gl, field, name, target, use);
}

Status checkSize(const std::string& field, Uint name, const TextureInfo& info, int width, int height) {
  if (info.width == width && info.height == height) return {};
  return invalid(field, name, "is " + textOf(info.width, info.height) + ", must be " + textOf(width, height));
}

} // namespace tyndall
