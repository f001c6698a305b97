// GLSL 3.30 of lights: what reaches a point through the shadow map, the glass map and the curves of smoke and strands.
// LitProgram puts it before the fragment shaders that light something.
#pragma once

namespace host::shaders {

/// relative space: world axes, about an origin that is near what is drawn. pass: which of the lights' kinds, or ambient
/// light. With TYNDALL_CURVE_NODES defined, behind the text of avsmLookup, the light has curves.
inline constexpr const char* kLights = R"(
#define AMBIENT 0
#define DIRECTIONAL 1
#define POINT 2
#define SPOT 3
const int kMaxViews = 6;
const float kPi = 3.14159265358979;

uniform int pass;
uniform vec3 lightPosition;  // relative
uniform vec3 lightDirection; // where the light travels to, length 1
uniform vec3 lightColour;
uniform float lightRange;
uniform vec2 spotScaleOffset;
uniform vec3 extinction;          // of what of the medium is the same everywhere, and of layers of density
uniform vec4 layerExtinction[2];  // exp(-max(e, ground)), e = dot(layerUp.xyz, position) + layerUp.w; w: ground
uniform vec4 layerUp[2];
uniform vec3 skyRadiance;
uniform float maxRadiance; // that the picture holds

uniform int viewCount; // 0: no shadow map
uniform mat4 shadowClipFromRelative[kMaxViews];
uniform int shadowLayer[kMaxViews];
uniform float shadowTexel[kMaxViews]; // world size of a texel; of perspective views at distance 1
uniform float shadowSize;             // texels per side
uniform vec2 depthFromNdc;            // scale and offset
uniform bool shadowReversed;
uniform bool shadowIsArray;
uniform bool litOutsideViews;
uniform bool hasGlass;
uniform sampler2DShadow shadowMap;
uniform sampler2DArrayShadow shadowArray;
uniform sampler2D glassColour;
uniform sampler2D glassDepth;
uniform sampler2DArray glassColourArray;
uniform sampler2DArray glassDepthArray;
#ifdef TYNDALL_CURVE_NODES
uniform usampler2DArray curves;
uniform vec4 curveDepth[kMaxViews]; // linear depth of a relative position
uniform float curveSize;            // texels per side
#endif

/// Mean density of a layer on the way between two exponents.
float meanDensity(float a, float b, float ground) {
  float low = max(min(a, b), ground), high = max(max(a, b), ground), width = abs(b - a);
  float share = high - low < width ? (high - low) / width : 1.0, x = high - low;
  return exp(-low) * (1.0 - share + share * (x < 1e-3 ? 1.0 - 0.5 * x : (1.0 - exp(-x)) / x));
}

/// Optical depth of the way between two points.
vec3 opticalDepth(vec3 from, vec3 to) {
  vec3 sum = extinction;
  for (int i = 0; i < 2; ++i) {
    float a = dot(layerUp[i].xyz, from) + layerUp[i].w, b = dot(layerUp[i].xyz, to) + layerUp[i].w;
    sum += layerExtinction[i].rgb * meanDensity(a, b, layerExtinction[i].w);
  }
  return distance(from, to) * sum;
}

/// The first view that holds the point from its near plane on, or -1. What lies beyond the far plane falls to the last.
int viewOf(vec3 position) {
  for (int i = 0; i < viewCount; ++i) {
    vec4 clip = shadowClipFromRelative[i] * vec4(position, 1.0);
    if (clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(clip.w)))) continue;
    float depth = clip.z / clip.w * depthFromNdc.x + depthFromNdc.y;
    if (shadowReversed) depth = 1.0 - depth;
    if (depth >= 0.0 && (depth <= 1.0 || i == viewCount - 1)) return i;
  }
  return -1;
}

/// Texture coordinates and depth of a point in a view. The depth is kept in [0, 1], the range of the map.
vec3 shadowCoordinates(int view, vec3 position) {
  vec4 clip = shadowClipFromRelative[view] * vec4(position, 1.0);
  vec3 ndc = clip.xyz / clip.w;
  return vec3(ndc.xy * 0.5 + 0.5, clamp(ndc.z * depthFromNdc.x + depthFromNdc.y, 0.0, 1.0));
}

/// Percentage-closer filter: 3 x 3 taps, each of them bilinear.
float visibilityAt(int view, vec3 coordinates) {
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      vec2 uv = coordinates.xy + vec2(x, y) / shadowSize;
      sum += shadowIsArray ? texture(shadowArray, vec4(uv, shadowLayer[view], coordinates.z))
                           : texture(shadowMap, vec3(uv, coordinates.z));
    }
  }
  return sum / 9.0;
}

vec3 glassTintOf(int view, ivec2 texel, float depth) {
  texel = clamp(texel, ivec2(0), ivec2(int(shadowSize) - 1));
  int layer = shadowLayer[view];
  float pane = shadowIsArray ? texelFetch(glassDepthArray, ivec3(texel, layer), 0).r
                             : texelFetch(glassDepth, texel, 0).r;
  bool behind = shadowReversed ? depth < pane : depth > pane;
  if (!behind) return vec3(1.0);
  return shadowIsArray ? texelFetch(glassColourArray, ivec3(texel, layer), 0).rgb
                       : texelFetch(glassColour, texel, 0).rgb;
}

/// Bilinear, with the depth test of each texel by itself.
vec3 glassTintAt(int view, vec3 coordinates) {
  vec2 position = coordinates.xy * shadowSize - 0.5;
  ivec2 low = ivec2(floor(position));
  vec2 weight = fract(position);
  vec3 bottom = mix(glassTintOf(view, low, coordinates.z), glassTintOf(view, low + ivec2(1, 0), coordinates.z), weight.x);
  vec3 top = mix(glassTintOf(view, low + ivec2(0, 1), coordinates.z), glassTintOf(view, low + ivec2(1, 1), coordinates.z),
                 weight.x);
  return mix(bottom, top, weight.y);
}

/// The share of a light that smoke and strands let through to a point, moved so far towards the light, but by no more
/// than a texel and a half of the curves' map.
float curveTransmittance(int view, vec3 position, vec3 toLight, float before, float lightDistance) {
#ifdef TYNDALL_CURVE_NODES
  position += toLight * min(before, 1.5 * shadowTexel[view] * lightDistance * shadowSize / curveSize);
  vec2 place = shadowCoordinates(view, position).xy;
  float depth = dot(curveDepth[view].xyz, position) + curveDepth[view].w;
  return tyndallTransmittanceBilinear(curves, place, view, depth);
#else
  return 1.0;
#endif
}

/// The share of a light that reaches a point. For the shadow map the point is moved by some of its texels along a
/// direction, for the curves as curveTransmittance() has it.
vec3 lightThrough(vec3 position, vec3 direction, float texels, vec3 toLight, float before, float lightDistance) {
  if (viewCount == 0) return vec3(1.0);
  int view = viewOf(position);
  if (view < 0) return vec3(litOutsideViews ? 1.0 : 0.0);
  vec3 coordinates = shadowCoordinates(view, position + direction * (texels * shadowTexel[view] * lightDistance));
  float visibility = visibilityAt(view, coordinates);
  if (visibility == 0.0) return vec3(0.0);
  visibility *= curveTransmittance(view, position, toLight, before, lightDistance);
  return hasGlass ? visibility * glassTintAt(view, coordinates) : vec3(visibility);
}

/// Irradiance on a plane that faces the light, were there nothing in its way; 0 where the light does not reach.
/// lightDistance: 1 for a directional light, whose shadow texels are as large everywhere.
vec3 unblockedIrradiance(vec3 position, out vec3 toLight, out float lightDistance) {
  toLight = -lightDirection;
  lightDistance = 1.0;
  vec3 strength = lightColour;
  if (pass != DIRECTIONAL) {
    toLight = lightPosition - position;
    lightDistance = length(toLight);
    if (lightDistance == 0.0 || lightDistance > lightRange) return vec3(0.0);
    toLight /= lightDistance;
    strength *= exp(-opticalDepth(lightPosition, position)) / (lightDistance * lightDistance);
  }
  if (pass == SPOT) {
    float falloff = clamp(dot(lightDirection, -toLight) * spotScaleOffset.x + spotScaleOffset.y, 0.0, 1.0);
    strength *= falloff * falloff;
  }
  return strength;
}
)";

} // namespace host::shaders
