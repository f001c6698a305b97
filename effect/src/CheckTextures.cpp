#include "CheckFrame.h"
#include "gl/OwnErrors.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace tyndall {

namespace {

using namespace gl; // GL's enumerants

enum class Use { Colour, Output, Depth, Tint, Curves };

struct Info {
  Int width = 0;
  Int height = 0;
  Int layers = 1;
  Int format = 0;
  Int samples = 0;
};

Status invalid(const std::string& field, Uint name, const std::string& rule) {
  return {StatusCode::InvalidFrame, "Frame::" + field + " is texture " + std::to_string(name) + ": " + rule};
}

const char* targetName(Enum target) {
  return target == TEXTURE_2D         ? "GL_TEXTURE_2D"
         : target == TEXTURE_2D_ARRAY ? "GL_TEXTURE_2D_ARRAY"
                                      : "GL_TEXTURE_2D_MULTISAMPLE";
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

// Largest finite value of a colour format.
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

// Binds a texture to the active unit, if it is of the target. Contexts that know no other way say so by an error.
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

// Leaves the texture bound.
Status inspect(const Functions& gl, const std::string& field, Uint name, Enum target, Info& info) {
  if (!gl.IsTexture(name))
    return invalid(field, name, "not the name of a texture in this context (deleted, or never bound?)");
  if (!bindIfOf(gl, name, target)) return invalid(field, name, std::string("must be a ") + targetName(target));
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_WIDTH, &info.width);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_HEIGHT, &info.height);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_INTERNAL_FORMAT, &info.format);
  if (target == TEXTURE_2D_ARRAY) gl.GetTexLevelParameteriv(target, 0, TEXTURE_DEPTH, &info.layers);
  if (target == TEXTURE_2D_MULTISAMPLE) gl.GetTexLevelParameteriv(target, 0, TEXTURE_SAMPLES, &info.samples);
  if (info.width < 1) return invalid(field, name, "has no level 0");
  if (target != TEXTURE_2D_MULTISAMPLE) {
    Int base = 0;
    gl.GetTexParameteriv(target, TEXTURE_BASE_LEVEL, &base);
    if (base != 0) return invalid(field, name, "GL_TEXTURE_BASE_LEVEL must be 0");
  }
  return {};
}

Status checkFormat(const std::string& field, Uint name, Use use, Int format) {
  if (use == Use::Depth && !isDepthFormat(format)) return invalid(field, name, "must have a depth format or R32F");
  if ((use == Use::Colour || use == Use::Output) && !isFloatColour(format))
    return invalid(field, name, "must have a float colour format (RGBA16F, RGBA32F, R11F_G11F_B10F, RGB16F, RGB32F)");
  if (use == Use::Tint && !isTint(format))
    return invalid(field, name, "must have an RGB or RGBA format of 8 bits or floats");
  if (use == Use::Curves && static_cast<Enum>(format) != RGBA32UI)
    return invalid(field, name, "must be what Avsm::curves() gave: RGBA32UI");
  return {};
}

// How many channels of a texture are read as they are stored. No sampler can undo what the texture's own parameters do
// to them; a tint may come in any order.
std::size_t channelsRead(Use use) {
  return use == Use::Depth ? 1 : use == Use::Output ? 3 : use == Use::Curves ? 4 : 0;
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
  if (use != Use::Depth) return {};
  Int mode = DEPTH_COMPONENT;
  if (gl.stencilTexturing) gl.GetTexParameteriv(target, DEPTH_STENCIL_TEXTURE_MODE, &mode);
  if (static_cast<Enum>(mode) != DEPTH_COMPONENT)
    return invalid(field, name, "GL_DEPTH_STENCIL_TEXTURE_MODE must be GL_DEPTH_COMPONENT");
  mode = RED;
  if (gl.compatibility) gl.GetTexParameteriv(target, DEPTH_TEXTURE_MODE, &mode);
  if (static_cast<Enum>(mode) == ALPHA) return invalid(field, name, "GL_DEPTH_TEXTURE_MODE must not be GL_ALPHA");
  return {};
}

// All that is asked of one texture but its size.
Status check(const Functions& gl, const std::string& field, Uint name, Enum target, Use use, Info& info) {
  if (Status s = inspect(gl, field, name, target, info); !s) return s;
  if (Status s = checkFormat(field, name, use, info.format); !s) return s;
  return checkChannels(gl, field, name, target, use);
}

Status sized(const std::string& field, Uint name, const Info& info, int width, int height) {
  if (info.width == width && info.height == height) return {};
  return invalid(field, name,
                 "is " + std::to_string(info.width) + " x " + std::to_string(info.height) + ", must be " +
                     std::to_string(width) + " x " + std::to_string(height));
}

Status checkTarget(const Functions& gl, const Frame& frame, const std::string& field, Uint name, Use use,
                   float& largest) {
  if (name == 0) return {};
  Info info;
  if (Status s = check(gl, field, name, TEXTURE_2D, use, info); !s) return s;
  largest = std::min(largest, largestValue(info.format));
  return sized(field, name, info, frame.viewport.width, frame.viewport.height);
}

Status checkDistinct(const Frame& frame) {
  const Output& out = frame.output;
  if (out.inscatter && (out.inscatter == frame.colour || out.inscatter == out.transmittance))
    return invalid("output.inscatter", out.inscatter, "must differ from colour and output.transmittance");
  if (out.transmittance && out.transmittance == frame.colour)
    return invalid("output.transmittance", out.transmittance, "must differ from colour");
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    if (const Uint glass = frame.lights[i].glass.colour;
        glass && (glass == frame.colour || glass == out.inscatter || glass == out.transmittance))
      return invalid("lights[" + std::to_string(i) + "].glass.colour", glass, "must differ from colour and output");
  return {};
}

Status checkCurves(const Functions& gl, const std::string& field, const Light& light, int& size) {
  Info info;
  const Uint name = light.curves.texture;
  if (Status s = check(gl, field, name, TEXTURE_2D_ARRAY, Use::Curves, info); !s) return s;
  const auto views = static_cast<int>(light.shadow.views.size());
  const int layers = views * light.curves.nodes / (light.curves.packed ? 4 : 2);
  if (info.width != info.height) return invalid(field, name, "must be as high as it is wide");
  if (info.layers < layers)
    return invalid(field, name,
                   "has " + std::to_string(info.layers) + " layers: " + std::to_string(views) + " views of " +
                       std::to_string(light.curves.nodes) + " nodes need " + std::to_string(layers));
  size = info.width;
  return {};
}

Status checkShadow(const Functions& gl, const std::string& field, const Light& light, FrameTextures::Shadow& shadow) {
  if (light.shadow.texture == 0) return {};
  const Enum target = light.shadow.array ? TEXTURE_2D_ARRAY : TEXTURE_2D;
  Info map;
  if (Status s = check(gl, field + "shadow.texture", light.shadow.texture, target, Use::Depth, map); !s) return s;
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i)
    if (light.shadow.array && light.shadow.views[i].layer >= map.layers)
      return {StatusCode::InvalidFrame, "Frame::" + field + "shadow.views[" + std::to_string(i) + "].layer is " +
                                            std::to_string(light.shadow.views[i].layer) + ": the shadow map has " +
                                            std::to_string(map.layers) + " layers"};
  shadow = {map.width, map.height};
  if (light.curves.texture != 0)
    if (Status s = checkCurves(gl, field + "curves.texture", light, shadow.curvesSize); !s) return s;
  if (light.glass.colour == 0) return {};
  Info colour, depth;
  if (Status s = check(gl, field + "glass.colour", light.glass.colour, target, Use::Tint, colour); !s) return s;
  if (Status s = sized(field + "glass.colour", light.glass.colour, colour, map.width, map.height); !s) return s;
  if (Status s = check(gl, field + "glass.depth", light.glass.depth, target, Use::Depth, depth); !s) return s;
  if (Status s = sized(field + "glass.depth", light.glass.depth, depth, map.width, map.height); !s) return s;
  if (colour.layers < map.layers)
    return invalid(field + "glass.colour", light.glass.colour, "has fewer layers than the shadow map");
  if (depth.layers < map.layers)
    return invalid(field + "glass.depth", light.glass.depth, "has fewer layers than the shadow map");
  return {};
}

} // namespace

Status checkTextures(const Functions& gl, const Frame& frame, FrameTextures& textures) {
  textures.colourMax = textures.outputMax = kLargestFloat;
  float most = kLargestFloat; // a transmittance is at most 1
  if (Status s = checkDistinct(frame); !s) return s;
  if (Status s = checkTarget(gl, frame, "colour", frame.colour, Use::Colour, textures.colourMax); !s) return s;
  if (Status s = checkTarget(gl, frame, "output.inscatter", frame.output.inscatter, Use::Output, textures.outputMax);
      !s)
    return s;
  if (Status s = checkTarget(gl, frame, "output.transmittance", frame.output.transmittance, Use::Output, most); !s)
    return s;
  Info depth;
  const Enum target = frame.depth.multisampled ? TEXTURE_2D_MULTISAMPLE : TEXTURE_2D;
  if (Status s = check(gl, "depth.texture", frame.depth.texture, target, Use::Depth, depth); !s) return s;
  if (Status s = sized("depth.texture", frame.depth.texture, depth, frame.viewport.width, frame.viewport.height); !s)
    return s;
  textures.depthSamples = frame.depth.multisampled ? std::clamp(depth.samples, 1, 16) : 1;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    textures.shadows.emplace_back();
    const std::string field = "lights[" + std::to_string(i) + "].";
    if (Status s = checkShadow(gl, field, frame.lights[i], textures.shadows.back()); !s) return s;
  }
  return {};
}

} // namespace tyndall
