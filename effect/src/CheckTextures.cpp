#include "CheckFrame.h"
#include "FieldText.h"
#include "gl/OwnErrors.h"
#include "optics/Blocks.h"
#include "optics/MapCopy.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace tyndall {

namespace {

using namespace gl; // GL's enumerants

enum class Use { Colour, Output, Depth, Map, Tint, Curves };

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

std::string textOf(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

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

// Of the bound texture; of a cube map's, of one face.
Info levelOf(const Functions& gl, Enum target) {
  Info info;
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_WIDTH, &info.width);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_HEIGHT, &info.height);
  gl.GetTexLevelParameteriv(target, 0, TEXTURE_INTERNAL_FORMAT, &info.format);
  return info;
}

// GL samples none of a cube map whose faces differ.
Status checkFaces(const Functions& gl, const std::string& field, Uint name, const Info& first) {
  constexpr std::array<const char*, 6> kFaces = {"POSITIVE_X", "NEGATIVE_X", "POSITIVE_Y",
                                                 "NEGATIVE_Y", "POSITIVE_Z", "NEGATIVE_Z"};
  for (Uint i = 0; i < kFaces.size(); ++i) {
    const Info face = levelOf(gl, TEXTURE_CUBE_MAP_POSITIVE_X + i);
    const std::string its = std::string("its face GL_TEXTURE_CUBE_MAP_") + kFaces[i];
    if (face.width < 1) return invalid(field, name, its + " has no level 0");
    if (face.width != first.width || face.height != first.height || face.format != first.format)
      return invalid(field, name, its + " must have the size and format of the others");
  }
  return {};
}

// Leaves the texture bound.
Status inspect(const Functions& gl, const std::string& field, Uint name, Enum target, Info& info) {
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
  if (use == Use::Curves && static_cast<Enum>(format) != RGBA32UI)
    return invalid(field, name, "must be what Avsm::curves() gave: RGBA32UI");
  return {};
}

// How many channels of a texture are read as they are stored. No sampler can undo what the texture's own parameters do
// to them; a tint may come in any order.
std::size_t channelsRead(Use use) {
  return use == Use::Depth || use == Use::Map ? 1 : use == Use::Output ? 3 : use == Use::Curves ? 4 : 0;
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

// All that is asked of one texture but its size.
Status check(const Functions& gl, const std::string& field, Uint name, Enum target, Use use, Info& info) {
  if (Status s = inspect(gl, field, name, target, info); !s) return s;
  if (Status s = checkFormat(field, name, use, info.format); !s) return s;
  return checkChannels(gl, field, name, target, use);
}

Status sized(const std::string& field, Uint name, const Info& info, int width, int height) {
  if (info.width == width && info.height == height) return {};
  return invalid(field, name, "is " + textOf(info.width, info.height) + ", must be " + textOf(width, height));
}

// A texture, one of whose layers is named unless that is -1.
struct Layered {
  std::string field;
  Uint name;
  std::string layerField;
  int layer;
};

Status checkLayered(const Functions& gl, const Layered& what, Enum one, Enum array, Use use, Info& info) {
  const Enum target = what.layer < 0 ? one : array;
  if (Status s = check(gl, what.field, what.name, target, use, info); !s) {
    if (s.message.find("must be a GL_") != std::string::npos)
      s.message += ", since " + what.layerField + " is " + std::to_string(what.layer);
    return s;
  }
  if (what.layer < info.layers) return {};
  return {StatusCode::InvalidFrame, "Frame::" + what.layerField + " is " + std::to_string(what.layer) + ": " +
                                        what.field + " has " + std::to_string(info.layers) + " layers"};
}

Status within(const std::string& field, const Rectangle& r, const std::string& texture, const Info& info) {
  const auto ends = [](int first, int length) { return std::int64_t{first} + length; };
  if (ends(r.x, r.width) <= info.width && ends(r.y, r.height) <= info.height) return {};
  return {StatusCode::InvalidFrame, "Frame::" + field + " is " + textOf(r) + ": must lie within " + texture +
                                        ", which is " + textOf(info.width, info.height)};
}

// What is drawn into: the viewport lies within the first, and the others are as large.
class TargetCheck {
public:
  TargetCheck(const Functions& gl, const Frame& frame) : gl_(gl), frame_(frame) {}

  Status operator()(const Layered& target, Use use, TargetTexture& found) {
    if (target.name == 0) return {};
    Info info;
    if (Status s = checkLayered(gl_, target, TEXTURE_2D, TEXTURE_2D_ARRAY, use, info); !s) return s;
    found = {static_cast<Enum>(info.format), largestValue(info.format)};
    if (first_.width == 0) {
      first_ = info;
      firstField_ = target.field;
      return within("viewport", frame_.viewport, target.field, info);
    }
    Status s = sized(target.field, target.name, info, first_.width, first_.height);
    if (!s) s.message += ", as " + firstField_;
    return s;
  }
  const Info& size() const { return first_; }

private:
  const Functions& gl_;
  const Frame& frame_;
  Info first_;
  std::string firstField_;
};

Status checkTargets(const Functions& gl, const Frame& frame, FrameTextures& textures, Info& size) {
  const Output& out = frame.output;
  TargetCheck check(gl, frame);
  if (Status s = check({"colour", frame.colour, "colourLayer", frame.colourLayer}, Use::Colour, textures.colour); !s)
    return s;
  if (Status s = check({"output.inscatter", out.inscatter, "output.layer", out.layer}, Use::Output, textures.inscatter);
      !s)
    return s;
  if (Status s = check({"output.transmittance", out.transmittance, "output.layer", out.layer}, Use::Output,
                       textures.transmittance);
      !s)
    return s;
  size = check.size();
  return {};
}

// Share of a distance by which a format rounds it, or the shader that makes it one.
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

Status checkDepth(const Functions& gl, const Frame& frame, const Info& targets, FrameTextures& textures) {
  const SceneDepth& depth = frame.depth;
  const Enum one = depth.multisampled ? TEXTURE_2D_MULTISAMPLE : TEXTURE_2D;
  const Enum array = depth.multisampled ? TEXTURE_2D_MULTISAMPLE_ARRAY : TEXTURE_2D_ARRAY;
  const Use use = depth.encoding == DepthEncoding::Window ? Use::Depth : Use::Map;
  Info info;
  if (Status s = checkLayered(gl, {"depth.texture", depth.texture, "depth.layer", depth.layer}, one, array, use, info);
      !s)
    return s;
  textures.depthSamples = depth.multisampled ? std::clamp(info.samples, 1, 16) : 1;
  textures.depthRounding = roundingOf(info.format);
  if (depth.rectangle.width > 0) return within("depth.rectangle", depth.rectangle, "depth.texture", info);
  Status s = sized("depth.texture", depth.texture, info, targets.width, targets.height);
  if (!s) s.message += ", or depth.rectangle say which texels show the viewport";
  return s;
}

Status checkDistinct(const Frame& frame) {
  const Output& out = frame.output;
  const bool mayShare = frame.colourLayer >= 0 && out.layer >= 0 && frame.colourLayer != out.layer; // layers of one
  if (out.inscatter && ((out.inscatter == frame.colour && !mayShare) || out.inscatter == out.transmittance))
    return invalid("output.inscatter", out.inscatter, "must differ from colour and output.transmittance");
  if (out.transmittance && out.transmittance == frame.colour && !mayShare)
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

Enum targetOf(const ShadowMap& map) {
  return map.cube.enabled ? (map.array ? TEXTURE_CUBE_MAP_ARRAY : TEXTURE_CUBE_MAP)
                          : (map.array ? TEXTURE_2D_ARRAY : TEXTURE_2D);
}

// Where views lie in the map.
Status checkPlaces(const std::string& field, const ShadowMap& shadow, const Info& map) {
  const auto outside = [&](const std::string& what, const std::string& value, const std::string& has) {
    return Status{StatusCode::InvalidFrame,
                  "Frame::" + field + "shadow." + what + " is " + value + ": the shadow map has " + has};
  };
  if (shadow.cube.enabled)
    return !shadow.array || shadow.cube.index < map.layers / 6
               ? Status{}
               : outside("cube.index", std::to_string(shadow.cube.index), std::to_string(map.layers / 6) + " cubes");
  for (std::size_t i = 0; i < shadow.views.size(); ++i) {
    const ShadowView& view = shadow.views[i];
    const Rectangle& r = view.rectangle;
    const std::string its = "views[" + std::to_string(i) + "].";
    if (shadow.array && view.layer >= map.layers)
      return outside(its + "layer", std::to_string(view.layer), std::to_string(map.layers) + " layers");
    if (r.width > map.width - r.x || r.height > map.height - r.y)
      return outside(its + "rectangle", textOf(r),
                     std::to_string(map.width) + " x " + std::to_string(map.height) + " texels");
  }
  return {};
}

bool isFixedPoint(Int format) {
  const auto f = static_cast<Enum>(format);
  return f == DEPTH_COMPONENT || f == DEPTH_COMPONENT16 || f == DEPTH_COMPONENT24 || f == DEPTH_COMPONENT32 ||
         f == DEPTH24_STENCIL8;
}

// What is farther than the greatest distance that a format holds could not be told from a caster there.
Status checkReach(const std::string& field, const Light& light, Int format) {
  const DepthScale& scale = light.shadow.scale;
  if (light.shadow.encoding == DepthEncoding::Window || !isFixedPoint(format)) return {};
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
    const double far = static_cast<double>(optics::copyBlock(light, static_cast<int>(i), {}, 0).copiedFar);
    if (far < kLargestFloat && std::max(scale.offset, scale.offset + scale.unit) < 0.9999 * far)
      return {StatusCode::InvalidFrame,
              "Frame::" + field + "shadow.scale.unit is " + std::to_string(scale.unit) +
                  ": a fixed-point format holds 0 to 1, which does not reach the far plane, " + std::to_string(far) +
                  " away"};
  }
  return {};
}

Status checkShadow(const Functions& gl, const std::string& field, const Light& light, FrameTextures::Shadow& shadow) {
  if (light.shadow.texture == 0) return {};
  const Enum target = targetOf(light.shadow);
  if (target == TEXTURE_CUBE_MAP_ARRAY && !gl.cubeArrays)
    return invalid(field + "shadow.texture", light.shadow.texture,
                   "a GL_TEXTURE_CUBE_MAP_ARRAY needs OpenGL 4.0 or GL_ARB_texture_cube_map_array");
  Info map;
  if (Status s = check(gl, field + "shadow.texture", light.shadow.texture, target, Use::Map, map); !s) return s;
  if (Status s = checkPlaces(field, light.shadow, map); !s) return s;
  if (Status s = checkReach(field, light, map.format); !s) return s;
  shadow.width = map.width;
  shadow.height = map.height;
  if (static_cast<Enum>(map.format) == R16F) shadow.rounding = 1.0 / 2048;
  if (light.curves.texture != 0)
    if (Status s = checkCurves(gl, field + "curves.texture", light, shadow.curvesSize); !s) return s;
  if (light.glass.colour == 0) return {};
  Info colour, depth;
  if (Status s = check(gl, field + "glass.colour", light.glass.colour, target, Use::Tint, colour); !s) return s;
  if (Status s = sized(field + "glass.colour", light.glass.colour, colour, map.width, map.height); !s) return s;
  if (Status s = check(gl, field + "glass.depth", light.glass.depth, target, Use::Map, depth); !s) return s;
  if (Status s = sized(field + "glass.depth", light.glass.depth, depth, map.width, map.height); !s) return s;
  shadow.floatTint = isFloatColour(colour.format) || static_cast<Enum>(colour.format) == SRGB8 ||
                     static_cast<Enum>(colour.format) == SRGB8_ALPHA8; // which is linear as it is read
  if (colour.layers < map.layers)
    return invalid(field + "glass.colour", light.glass.colour, "has fewer layers than the shadow map");
  if (depth.layers < map.layers)
    return invalid(field + "glass.depth", light.glass.depth, "has fewer layers than the shadow map");
  return {};
}

} // namespace

Status checkTextures(const Functions& gl, const Frame& frame, FrameTextures& textures) {
  if (Status s = checkDistinct(frame); !s) return s;
  Info targets;
  if (Status s = checkTargets(gl, frame, textures, targets); !s) return s;
  if (Status s = checkDepth(gl, frame, targets, textures); !s) return s;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    textures.shadows.emplace_back();
    const std::string field = "lights[" + std::to_string(i) + "].";
    if (Status s = checkShadow(gl, field, frame.lights[i], textures.shadows.back()); !s) return s;
  }
  return {};
}

} // namespace tyndall
