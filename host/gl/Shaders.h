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

/// The transmittance of a pane or a blended surface, blended by multiplication. Alpha is the share that the surface
/// covers: the rest lets all of the light through. What is opaque is not drawn: it casts a shadow.
inline constexpr const char* kGlassFragment = R"(#version 330 core
in vec2 surfaceUv;
uniform sampler2D baseTexture;
uniform vec4 baseColour;
uniform float alphaCutoff;
uniform float transmission;
uniform bool coveredByAlpha;
uniform float opaqueAlpha;
layout(location = 0) out vec4 transmittance;
void main() {
  float alpha = baseColour.a * textureLod(baseTexture, surfaceUv, 0.0).a;
  if (alpha < alphaCutoff || alpha >= opaqueAlpha) discard;
  vec4 texel = texture(baseTexture, surfaceUv);
  vec3 colour = clamp(baseColour.rgb * texel.rgb * transmission, 0.0, 1.0);
  transmittance = vec4(coveredByAlpha ? mix(vec3(1.0), colour, baseColour.a * texel.a) : colour, 1.0);
}
)";

/// relative space: world axes, the camera at the origin, so that floats keep their precision far from the world's
/// origin.
inline constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 nodePosition;
layout(location = 1) in vec3 nodeNormal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
uniform mat4 clipFromNode;
uniform mat4 relativeFromNode;
uniform mat3 relativeFromNodeNormal;
out vec3 relativePosition;
out vec3 relativeNormal;
out vec2 surfaceUv;
out vec3 surfaceColour;
invariant gl_Position;
void main() {
  surfaceUv = uv;
  surfaceColour = colour.rgb;
  relativePosition = (relativeFromNode * vec4(nodePosition, 1.0)).xyz;
  relativeNormal = relativeFromNodeNormal * nodeNormal;
  gl_Position = clipFromNode * vec4(nodePosition, 1.0);
}
)";

/// A Lambert surface: emission and ambient light in one pass, then one pass a light. Writes linear radiance and alpha.
/// Goes behind kLights.
inline constexpr const char* kSurfaceFragment = R"(
in vec3 relativePosition;
in vec3 relativeNormal;
in vec2 surfaceUv;
in vec3 surfaceColour;
layout(location = 0) out vec4 radiance;

uniform sampler2D baseTexture;
uniform vec4 baseColour;
uniform vec3 emission;
uniform float alphaCutoff;
uniform bool unlit;
uniform vec4 eye; // xyz - w * position points to the viewer, for perspective and orthographic cameras

/// Fades the light out where the face turns away from it though the shading normal does not: else the edge of the
/// lit side would show the triangles. Chiang et al., "Taming the Shadow Terminator" (SIGGRAPH 2019 Talks), equation 3.
float terminator(float cosine, float faceCosine, float normalCosine) {
  float g = min(1.0, faceCosine / (cosine * max(normalCosine, 1e-3)));
  return g * (1.0 + g * (1.0 - g));
}

/// Irradiance on the surface; shadingNormal and faceNormal point to the viewer's side. For the shadow map the position is
/// moved off the surface by what its slope makes of the filter's reach: taps look up to 2 sqrt(2) texels aside, where a
/// plane at angle theta to the light is nearer by 2 sqrt(2) texels * tan(theta); a shift by d along the normal gains
/// d / cos(theta). Half a texel more guards against rounding.
vec3 irradiance(vec3 shadingNormal, vec3 faceNormal) {
  vec3 toLight;
  float lightDistance;
  vec3 strength = unblockedIrradiance(relativePosition, toLight, lightDistance);
  float faceCosine = dot(faceNormal, toLight);
  float cosine = dot(shadingNormal, toLight);
  if (faceCosine <= 0.0 || cosine <= 0.0 || strength == vec3(0.0)) return vec3(0.0);
  strength *= cosine * terminator(cosine, faceCosine, dot(shadingNormal, faceNormal));
  float texels = 2.83 * sqrt(max(0.0, 1.0 - faceCosine * faceCosine)) + 0.5;
  return strength * lightThrough(relativePosition, faceNormal, texels, toLight, 0.0, lightDistance);
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

  vec3 albedo = baseColour.rgb * texel.rgb * surfaceColour;
  vec3 result = vec3(0.0);
  if (pass == AMBIENT) result = emission + (unlit ? albedo : ambient(albedo, normal));
  else if (!unlit) result = albedo / kPi * irradiance(normal, face);
  radiance = vec4(min(result, maxRadiance), alpha);
}
)";

} // namespace host::shaders
