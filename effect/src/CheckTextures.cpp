#include "CheckFrame.h"
#include "FieldText.h"
#include "InspectTexture.h"
#include "optics/Blocks.h"
#include "optics/MapCopy.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>

namespace tyndall {

namespace {

using namespace gl; // GL's enumerants

// A texture, one of whose layers is named unless that is -1.
struct Layered {
  std::string field;
  Uint name;
  std::string layerField;
  int layer;
};

Status checkLayered(const Functions& gl, const Layered& what, Enum one, Enum array, Use use, TextureInfo& info) {
  const Enum target = what.layer < 0 ? one : array;
  if (Status s = checkTexture(gl, what.field, what.name, target, use, info); !s) {
    if (s.message.find("must be a GL_") != std::string::npos)
      s.message += ", since " + what.layerField + " is " + std::to_string(what.layer);
    return s;
  }
  if (what.layer < info.layers) return {};
  return {StatusCode::InvalidFrame, "Frame::" + what.layerField + " is " + std::to_string(what.layer) + ": " +
                                        what.field + " has " + std::to_string(info.layers) + " layers"};
}

Status within(const std::string& field, const Rectangle& r, const std::string& texture, const TextureInfo& info) {
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
    TextureInfo info;
    if (Status s = checkLayered(gl_, target, TEXTURE_2D, TEXTURE_2D_ARRAY, use, info); !s) return s;
    found = {static_cast<Enum>(info.format), largestValue(info.format)};
    if (first_.width == 0) {
      first_ = info;
      firstField_ = target.field;
      return within("viewport", frame_.viewport, target.field, info);
    }
    Status s = checkSize(target.field, target.name, info, first_.width, first_.height);
    if (!s) s.message += ", as " + firstField_;
    return s;
  }
  const TextureInfo& size() const { return first_; }

private:
  const Functions& gl_;
  const Frame& frame_;
  TextureInfo first_;
  std::string firstField_;
};

Status checkTargets(const Functions& gl, const Frame& frame, FrameTextures& textures, TextureInfo& size) {
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

Status checkDepth(const Functions& gl, const Frame& frame, const TextureInfo& targets, FrameTextures& textures) {
  const SceneDepth& depth = frame.depth;
  const Enum one = depth.multisampled ? TEXTURE_2D_MULTISAMPLE : TEXTURE_2D;
  const Enum array = depth.multisampled ? TEXTURE_2D_MULTISAMPLE_ARRAY : TEXTURE_2D_ARRAY;
  const Use use = depth.encoding == DepthEncoding::Window ? Use::Depth : Use::Map;
  TextureInfo info;
  if (Status s = checkLayered(gl, {"depth.texture", depth.texture, "depth.layer", depth.layer}, one, array, use, info);
      !s)
    return s;
  textures.depthSamples = depth.multisampled ? std::clamp(info.samples, 1, 16) : 1;
  textures.depthRounding = roundingOf(info.format);
  if (depth.rectangle.width > 0) return within("depth.rectangle", depth.rectangle, "depth.texture", info);
  Status s = checkSize("depth.texture", depth.texture, info, targets.width, targets.height);
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
  if (const Uint share = frame.ambient.occlusion.texture;
      share && (share == frame.colour || share == out.inscatter || share == out.transmittance))
    return invalid("ambient.occlusion.texture", share, "must differ from colour and output");
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    if (const Uint glass = frame.lights[i].glass.colour;
        glass && (glass == frame.colour || glass == out.inscatter || glass == out.transmittance))
      return invalid("lights[" + std::to_string(i) + "].glass.colour", glass, "must differ from colour and output");
  return {};
}

Status checkCurves(const Functions& gl, const std::string& field, const AvsmCurves& curves, int views, int& size) {
  if (curves.texture == 0) return {};
  TextureInfo info;
  const Uint name = curves.texture;
  if (Status s = checkTexture(gl, field, name, TEXTURE_2D_ARRAY, Use::Curves, info); !s) return s;
  const int layers = views * curves.nodes / (curves.packed ? 4 : 2);
  if (info.width != info.height) return invalid(field, name, "must be as high as it is wide");
  if (info.layers < layers)
    return invalid(field, name,
                   "has " + std::to_string(info.layers) + " layers: " + std::to_string(views) + " views of " +
                       std::to_string(curves.nodes) + " nodes need " + std::to_string(layers));
  size = info.width;
  return {};
}

Status checkOcclusion(const Functions& gl, const Ambient& ambient, FrameTextures& textures) {
  if (ambient.occlusion.texture == 0) return {};
  TextureInfo info;
  if (Status s =
          checkTexture(gl, "ambient.occlusion.texture", ambient.occlusion.texture, TEXTURE_2D, Use::Occlusion, info);
      !s)
    return s;
  textures.occlusion = {info.width, info.height};
  return {};
}

// Of the two the first sets the size.
Status checkLookup(const Functions& gl, const Frame& frame, FrameTextures& textures) {
  constexpr int kMostTexels = 512, kLeastLayers = 2, kMostLayers = 64;
  for (const auto& [field, name, format] :
       {std::tuple{"lookup.inscatter", frame.lookup.inscatter, &textures.lookup.inscatter},
        std::tuple{"lookup.transmittance", frame.lookup.transmittance, &textures.lookup.transmittance}}) {
    if (name == 0) continue;
    TextureInfo info;
    if (Status s = checkTexture(gl, field, name, TEXTURE_2D_ARRAY, Use::Output, info); !s) return s;
    *format = {static_cast<Enum>(info.format), largestValue(info.format)};
    const Uint texture = name;
    const bool isGlass = std::any_of(frame.lights.begin(), frame.lights.end(),
                                     [&](const Light& light) { return light.glass.colour == texture; });
    if (name == frame.colour || name == frame.output.inscatter || name == frame.output.transmittance || isGlass)
      return invalid(field, name, "must differ from colour, output and glass");
    if (info.width > kMostTexels || info.height > kMostTexels)
      return invalid(field, name, "is " + textOf(info.width, info.height) + ", must be 512 x 512 at most");
    if (info.layers < kLeastLayers || info.layers > kMostLayers)
      return invalid(field, name, "has " + std::to_string(info.layers) + " layers, must have 2 to 64");
    FrameTextures::Lookup& lookup = textures.lookup;
    if (lookup.depths != 0) {
      if (Status s = checkSize(field, name, info, lookup.width, lookup.height); !s) return s;
      if (info.layers != lookup.depths)
        return invalid(field, name,
                       "has " + std::to_string(info.layers) + " layers, lookup.inscatter " +
                           std::to_string(lookup.depths));
    }
    lookup.width = info.width;
    lookup.height = info.height;
    lookup.depths = info.layers;
  }
  if (frame.lookup.inscatter != 0 && frame.lookup.inscatter == frame.lookup.transmittance)
    return invalid("lookup.transmittance", frame.lookup.transmittance, "must differ from lookup.inscatter");
  return {};
}

Enum targetOf(const ShadowMap& map) {
  return map.cube.enabled ? (map.array ? TEXTURE_CUBE_MAP_ARRAY : TEXTURE_CUBE_MAP)
                          : (map.array ? TEXTURE_2D_ARRAY : TEXTURE_2D);
}

// Where views lie in the map.
Status checkPlaces(const std::string& field, const ShadowMap& shadow, const TextureInfo& map) {
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
  TextureInfo map;
  if (Status s = checkTexture(gl, field + "shadow.texture", light.shadow.texture, target, Use::Map, map); !s) return s;
  if (Status s = checkPlaces(field, light.shadow, map); !s) return s;
  if (Status s = checkReach(field, light, map.format); !s) return s;
  shadow.width = map.width;
  shadow.height = map.height;
  if (static_cast<Enum>(map.format) == R16F) shadow.rounding = 1.0 / 2048;
  const auto views = static_cast<int>(light.shadow.views.size());
  if (Status s = checkCurves(gl, field + "curves.texture", light.curves, views, shadow.curvesSize); !s) return s;
  if (light.glass.colour == 0) return {};
  TextureInfo colour, depth;
  if (Status s = checkTexture(gl, field + "glass.colour", light.glass.colour, target, Use::Tint, colour); !s) return s;
  if (Status s = checkSize(field + "glass.colour", light.glass.colour, colour, map.width, map.height); !s) return s;
  if (Status s = checkTexture(gl, field + "glass.depth", light.glass.depth, target, Use::Map, depth); !s) return s;
  if (Status s = checkSize(field + "glass.depth", light.glass.depth, depth, map.width, map.height); !s) return s;
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
  TextureInfo targets;
  if (Status s = checkTargets(gl, frame, textures, targets); !s) return s;
  if (Status s = checkDepth(gl, frame, targets, textures); !s) return s;
  if (Status s = checkOcclusion(gl, frame.ambient, textures); !s) return s;
  if (Status s = checkLookup(gl, frame, textures); !s) return s;
  if (Status s = checkCurves(gl, "eyeCurves.curves.texture", frame.eyeCurves.curves, 1, textures.eyeCurves); !s)
    return s;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    textures.shadows.emplace_back();
    const std::string field = "lights[" + std::to_string(i) + "].";
    if (Status s = checkShadow(gl, field, frame.lights[i], textures.shadows.back()); !s) return s;
  }
  return {};
}

} // namespace tyndall
