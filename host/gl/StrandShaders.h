// GLSL of strands: ribbons that face the eye, never thinner than a pixel; what they are thinner in truth makes them
// clearer instead. Without #version lines: 3.30 for the picture, 4.30 for the capture.
#pragma once

namespace host::shaders {

/// Reads points: (position, width), (tangent, opacity) and (albedo, 0) of each, and segments: two points.
inline constexpr const char* kStrandVertex = R"(
uniform samplerBuffer points;
uniform usamplerBuffer segments;
uniform mat4 clipFromRelative;
uniform vec4 eye;        // relative; w = 0 of an orthographic view: the direction to the viewer
uniform int firstQuad;   // of this draw
uniform float pixelSize; // world size of a pixel where clip w is 1
uniform float feather;   // pixels that the ribbon is wider than its strand, for smooth edges
flat out float opacity;
out float aside;     // pixels from the strand's middle line
out float halfWidth; // of the strand, pixels
#ifdef LIT
uniform sampler2D light;
uniform int lightsAcross;
out vec3 lit;
#else
out vec3 relativePosition;
#endif
void main() {
  int index = int(texelFetch(segments, firstQuad + gl_InstanceID)[gl_VertexID >> 1]);
  vec4 at = texelFetch(points, 3 * index), along = texelFetch(points, 3 * index + 1);
  vec3 toViewer = eye.xyz - eye.w * at.xyz;
  vec3 across = cross(along.xyz, toViewer);
  float size = length(across);
  across = size > 0.0 ? across / size : vec3(0.0); // seen along its length a strand covers nothing
  float pixel = pixelSize * (clipFromRelative * vec4(at.xyz, 1.0)).w;
  float width = max(at.w / pixel, feather > 0.0 ? 0.0 : 1.0);
  float side = float(gl_VertexID & 1) * 2.0 - 1.0;
  halfWidth = 0.5 * at.w / pixel;
  aside = side * 0.5 * (width + feather);
  opacity = along.w;
  gl_Position = clipFromRelative * vec4(at.xyz + across * (aside * pixel), 1.0);
#ifdef LIT
  lit = texelFetch(light, ivec2(index % lightsAcross, index / lightsAcross), 0).rgb;
#else
  relativePosition = at.xyz;
#endif
}
)";

/// Captures for an adaptive volumetric shadow map: a strand dims the light at once. A ribbon is a texel wide at least,
/// so that on average it covers as many texels as it crosses.
inline constexpr const char* kStrandCapture = R"(
flat in float opacity;
in float halfWidth;
in vec3 relativePosition;
uniform vec4 depthPlane; // linear depth of a relative position
uniform int layer;
void main() {
  float depth = dot(depthPlane.xyz, relativePosition) + depthPlane.w;
  tyndallCapture(ivec3(gl_FragCoord.xy, layer), depth, depth, 1.0 - opacity * min(1.0, 2.0 * halfWidth));
}
)";

/// Radiance towards the eye of each point. Goes behind kLights. After Kajiya and Kay (1989) a strand is a thin
/// cylinder: diffuse by the sine of the angle between tangent and light. Its gloss are two of the lobes of Marschner et
/// al. (2003), Gaussians of the mean of the angles that light and eye make with the plane across the strand: R, light
/// reflected at the tilted scales of its surface, white, and TRT, reflected inside after two passes, in its colour; the
/// shifts are -alpha and 3/2 alpha, and TT, straight through, makes strands before a light shine.
inline constexpr const char* kStrandLight = R"(
uniform samplerBuffer points;
uniform int count;
uniform int lightsAcross;
uniform vec4 eye;
layout(location = 0) out vec4 radiance;
const float kTilt = 0.06;  // alpha, radians
const float kRough = 0.13; // of R, radians; of the others some times that

float lobe(float width, float x) { return exp(-0.5 * x * x / (width * width)) / (width * 2.5066283); }

vec3 towardsEye(vec3 albedo, vec3 tangent, vec3 toLight, vec3 toEye) {
  float sinLight = clamp(dot(tangent, toLight), -1.0, 1.0), sinEye = clamp(dot(tangent, toEye), -1.0, 1.0);
  float cosLight = sqrt(1.0 - sinLight * sinLight);
  float halfAngle = 0.5 * (asin(sinLight) + asin(sinEye));
  vec3 lightAcross = toLight - sinLight * tangent, eyeAcross = toEye - sinEye * tangent;
  float cosAround = dot(lightAcross, eyeAcross) / max(1e-4, length(lightAcross) * length(eyeAcross)); // 1e-4: end on
  // 1 with the light behind the eye, 0 with the strand between them; rounding must not pass either.
  float facing = clamp(0.5 + 0.5 * cosAround, 0.0, 1.0);
  vec3 gloss = vec3(0.022 * sqrt(facing) * lobe(kRough, halfAngle + kTilt));
  gloss += 0.08 * albedo * facing * facing * lobe(2.0 * kRough, halfAngle - 1.5 * kTilt);
  gloss += 0.07 * sqrt(albedo) * pow(1.0 - facing, 6.0) * lobe(1.3 * kRough, halfAngle - 0.5 * kTilt);
  return cosLight * (albedo / kPi * (0.55 + 0.45 * facing) + gloss);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int index = texel.y * lightsAcross + texel.x;
  if (index >= count) discard;
  vec4 point = texelFetch(points, 3 * index);
  vec3 position = point.xyz, tangent = texelFetch(points, 3 * index + 1).xyz;
  vec3 albedo = texelFetch(points, 3 * index + 2).rgb;
  radiance = vec4(0.25 * albedo * skyRadiance, 0.0);
  if (pass == AMBIENT) return;
  vec3 toLight;
  float lightDistance;
  vec3 strength = unblockedIrradiance(position, toLight, lightDistance);
  // Before its own place in the curves, so that a strand does not dim itself: a strand that fills a texel lies in it as
  // a slope; of a finer one there is little in it, and more texels would leave out much of what lies before it.
  if (strength != vec3(0.0)) strength *= lightThrough(position, toLight, 1.5, toLight, 1.5 * point.w, lightDistance);
  vec3 toEye = normalize(eye.xyz - eye.w * position);
  radiance = vec4(min(strength * towardsEye(albedo, tangent, toLight, toEye), maxRadiance), 0.0);
}
)";

/// The picture: radiance, and the part of the pixel that is covered as alpha.
inline constexpr const char* kStrandFragment = R"(
flat in float opacity;
in float aside;
in float halfWidth;
in vec3 lit;
layout(location = 0) out vec4 result;
void main() {
  float covered = min(aside + 0.5, halfWidth) - max(aside - 0.5, -halfWidth);
  float alpha = opacity * clamp(covered, 0.0, 1.0);
  if (alpha < 1.0 / 256.0) discard;
  result = vec4(lit, alpha);
}
)";

} // namespace host::shaders
