// GLSL 3.30 of the forward renderer.
#pragma once

namespace host::shaders {

/// Positions and texture coordinates, for depth and glass maps.
inline constexpr const char* kDepthVertex = R"(#version 330 core
layout(location = 0) in vec3 nodePosition;
layout(location = 2) in vec2 uv;
uniform mat4 clipFromNode;
out vec2 surfaceUv;
void main() {
  surfaceUv = uv;
  gl_Position = clipFromNode * vec4(nodePosition, 1.0);
}
)";

/// Depth only. ALPHA_TESTED: cut out where alpha is below the cutoff, read at level 0 so that the outline does not
/// depend on the distance.
inline constexpr const char* kDepthFragment = R"(#version 330 core
in vec2 surfaceUv;
#ifdef ALPHA_TESTED
uniform sampler2D baseTexture;
uniform vec4 baseColour;
uniform float alphaCutoff;
void main() {
  if (baseColour.a * textureLod(baseTexture, surfaceUv, 0.0).a < alphaCutoff) discard;
}
#else
void main() {}
#endif
)";

/// The transmittance of a pane, blended by multiplication.
inline constexpr const char* kGlassFragment = R"(#version 330 core
in vec2 surfaceUv;
uniform sampler2D baseTexture;
uniform vec4 baseColour;
uniform float alphaCutoff;
uniform float transmission;
layout(location = 0) out vec4 transmittance;
void main() {
  if (baseColour.a * textureLod(baseTexture, surfaceUv, 0.0).a < alphaCutoff) discard;
  vec3 colour = baseColour.rgb * texture(baseTexture, surfaceUv).rgb * transmission;
  transmittance = vec4(clamp(colour, 0.0, 1.0), 1.0);
}
)";

/// relative space: world axes, the camera at the origin, so that floats keep their precision far from the world's
/// origin.
inline constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 nodePosition;
layout(location = 1) in vec3 nodeNormal;
layout(location = 2) in vec2 uv;
uniform mat4 clipFromNode;
uniform mat4 relativeFromNode;
uniform mat3 relativeFromNodeNormal;
out vec3 relativePosition;
out vec3 relativeNormal;
out vec2 surfaceUv;
invariant gl_Position;
void main() {
  surfaceUv = uv;
  relativePosition = (relativeFromNode * vec4(nodePosition, 1.0)).xyz;
  relativeNormal = relativeFromNodeNormal * nodeNormal;
  gl_Position = clipFromNode * vec4(nodePosition, 1.0);
}
)";

/// A Lambert surface: emission and ambient light in one pass, then one pass a light. Writes linear radiance and alpha.
inline constexpr const char* kSurfaceFragment = R"(#version 330 core
#define AMBIENT 0
#define DIRECTIONAL 1
#define POINT 2
#define SPOT 3
const int kMaxViews = 6;
const float kPi = 3.14159265358979;
const float kMaxRadiance = 6.0e4; // half floats end at 65504

in vec3 relativePosition;
in vec3 relativeNormal;
in vec2 surfaceUv;
layout(location = 0) out vec4 radiance;

uniform sampler2D baseTexture;
uniform vec4 baseColour;
uniform vec3 emission;
uniform float alphaCutoff;
uniform vec4 eye; // xyz - w * position points to the viewer, for perspective and orthographic cameras
uniform vec3 skyRadiance;

uniform int pass;
uniform vec3 lightPosition;  // relative
uniform vec3 lightDirection; // where the light travels to, length 1
uniform vec3 lightColour;
uniform float lightRange;
uniform vec2 spotScaleOffset;
uniform vec3 extinction;

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

/// Light that reaches a surface. The position is moved off the surface by what its slope makes of the filter's reach:
/// taps look up to 2 sqrt(2) texels aside, where a plane at angle theta to the light is nearer by 2 sqrt(2) texels
/// * tan(theta); a shift by d along the normal gains d / cos(theta). Half a texel more guards against rounding.
vec3 lightThrough(vec3 normal, float cosTheta, float lightDistance) {
  if (viewCount == 0) return vec3(1.0);
  int view = viewOf(relativePosition);
  if (view < 0) return vec3(litOutsideViews ? 1.0 : 0.0);
  float texel = shadowTexel[view] * lightDistance;
  float sinTheta = sqrt(max(0.0, 1.0 - cosTheta * cosTheta));
  vec3 coordinates = shadowCoordinates(view, relativePosition + normal * (texel * (2.83 * sinTheta + 0.5)));
  float visibility = visibilityAt(view, coordinates);
  if (!hasGlass || visibility == 0.0) return vec3(visibility);
  return visibility * glassTintAt(view, coordinates);
}

/// Fades the light out where the face turns away from it though the shading normal does not: else the edge of the
/// lit side would show the triangles. Chiang et al., "Taming the Shadow Terminator" (SIGGRAPH 2019 Talks), equation 3.
float terminator(float cosine, float faceCosine, float normalCosine) {
  float g = min(1.0, faceCosine / (cosine * max(normalCosine, 1e-3)));
  return g * (1.0 + g * (1.0 - g));
}

/// Irradiance on the surface; shadingNormal and faceNormal point to the viewer's side.
vec3 irradiance(vec3 shadingNormal, vec3 faceNormal) {
  vec3 toLight = -lightDirection;
  vec3 strength = lightColour;
  float lightDistance = 1.0; // of a directional light, whose texels are as large everywhere
  if (pass != DIRECTIONAL) {
    toLight = lightPosition - relativePosition;
    lightDistance = length(toLight);
    if (lightDistance == 0.0 || lightDistance > lightRange) return vec3(0.0);
    toLight /= lightDistance;
    strength *= exp(-extinction * lightDistance) / (lightDistance * lightDistance);
  }
  if (pass == SPOT) {
    float falloff = clamp(dot(lightDirection, -toLight) * spotScaleOffset.x + spotScaleOffset.y, 0.0, 1.0);
    strength *= falloff * falloff;
  }
  float faceCosine = dot(faceNormal, toLight);
  float cosine = dot(shadingNormal, toLight);
  if (faceCosine <= 0.0 || cosine <= 0.0 || strength == vec3(0.0)) return vec3(0.0);
  strength *= cosine * terminator(cosine, faceCosine, dot(shadingNormal, faceNormal));
  return strength * lightThrough(faceNormal, faceCosine, lightDistance);
}

/// Radiance of a surface under the sky, in place of true ambient occlusion: a surface that looks to the brightest part
/// of the sky sees two fifths of it, one that looks away 3/20, by way of the ground. That part is off the zenith, so
/// that upright surfaces differ and keep their form in the shade.
vec3 ambient(vec3 albedo, vec3 normal) {
  const vec3 brightest = vec3(0.36, 0.86, 0.36);
  return albedo * skyRadiance * mix(0.15, 0.4, 0.5 + 0.5 * dot(normal, brightest));
}

void main() {
  vec4 texel = texture(baseTexture, surfaceUv);
  float alpha = baseColour.a * texel.a;
  if (alphaCutoff > 0.0 && baseColour.a * textureLod(baseTexture, surfaceUv, 0.0).a < alphaCutoff) discard;

  vec3 toViewer = eye.xyz - eye.w * relativePosition;
  vec3 face = cross(dFdx(relativePosition), dFdy(relativePosition));
  if (dot(face, face) == 0.0) face = relativeNormal; // lines and points
  face = dot(face, face) > 0.0 ? normalize(face) : normalize(toViewer);
  if (dot(face, toViewer) < 0.0) face = -face;
  vec3 normal = dot(relativeNormal, relativeNormal) > 0.0 ? normalize(relativeNormal) : face;
  if (dot(normal, face) < 0.0) normal = -normal;

  vec3 albedo = baseColour.rgb * texel.rgb;
  vec3 result = pass == AMBIENT ? ambient(albedo, normal) + emission : albedo / kPi * irradiance(normal, face);
  radiance = vec4(min(result, kMaxRadiance), alpha);
}
)";

} // namespace host::shaders
