// GLSL of smoke: balls as quads, whose fragments integrate along the chord. Without #version lines: 3.30 for the
// picture, 4.30 for the capture.
//
// Extinction in a ball is density (1 - r^2/R^2)^2 (scene/Smoke.h). A line at a distance b from its middle has h^2 = R^2
// - b^2, and at s from the chord's middle 1 - r^2/R^2 = (h^2 - s^2)/R^2; so the optical depth from there to s is
//
//     F(s) = density/R^4 (h^4 s - 2/3 h^2 s^3 + 1/5 s^5),  F(h) = density 8/15 h^5/R^4.
#pragma once

namespace host::shaders {

/// Reads particles: (position, radius) and (albedo, density) of each. A quad that holds the ball's outline, in a plane
/// through its middle that faces the eye or, of an eye inside the ball or close to it, all that is seen. Depth is not
/// tested: it is kept inside the clip planes.
inline constexpr const char* kSmokeVertex = R"(
uniform samplerBuffer particles;
uniform mat4 clipFromRelative;
uniform mat4 relativeFromClip;
uniform vec4 eye; // relative; w = 0 of an orthographic view: the direction to the viewer
uniform int firstQuad; // of this draw
flat out vec4 ball;
flat out vec4 matter;
flat out int index;
out vec3 place; // on the fragment's line of sight
void main() {
  index = firstQuad + gl_InstanceID;
  ball = texelFetch(particles, 2 * index);
  matter = texelFetch(particles, 2 * index + 1);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec3 toViewer = eye.xyz - eye.w * ball.xyz;
  float distance = length(toViewer);
  bool closeBy = eye.w != 0.0 && distance < 1.05 * ball.w;
  if (closeBy) {
    vec4 seen = relativeFromClip * vec4(corner, 0.5, 1.0);
    place = seen.xyz / seen.w;
    gl_Position = vec4(corner, 0.0, 1.0);
    return;
  }
  vec3 axis = toViewer / distance;
  vec3 across = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  float outline = ball.w; // the radius of the cone around the ball, at its middle
  if (eye.w != 0.0) outline /= sqrt(1.0 - ball.w * ball.w / (distance * distance));
  place = ball.xyz + outline * (corner.x * across + corner.y * cross(axis, across));
  gl_Position = clipFromRelative * vec4(place, 1.0);
  gl_Position.z = 0.0;
}
)";

/// What both fragment shaders need: the line of sight and the optical depth along it.
inline constexpr const char* kSmokeChord = R"(
flat in vec4 ball;
flat in vec4 matter;
flat in int index;
in vec3 place;
uniform vec4 eye;

struct Chord {
  vec3 origin, direction; // of the line of sight, which begins at the origin of a perspective view
  float middle;           // where it passes the ball's middle, along the direction
  float halfLength;       // negative: it misses the ball
};

Chord chordOf() {
  Chord chord;
  chord.origin = eye.w != 0.0 ? eye.xyz : place;
  chord.direction = eye.w != 0.0 ? normalize(place - eye.xyz) : -eye.xyz;
  vec3 toBall = ball.xyz - chord.origin;
  chord.middle = dot(toBall, chord.direction);
  vec3 aside = toBall - chord.middle * chord.direction;
  float square = ball.w * ball.w - dot(aside, aside);
  chord.halfLength = square > 0.0 ? sqrt(square) : -1.0;
  return chord;
}

// F(s) above.
float opticalDepth(float h, float s) {
  float u = s / ball.w, v = h * h / (ball.w * ball.w);
  return matter.w * ball.w * u * (v * v + u * u * (0.2 * u * u - 2.0 / 3.0 * v));
}
)";

/// Captures for an adaptive volumetric shadow map. A segment is an even medium, but a ball is densest in its middle:
/// the segment has the ball's optical depth and its variance along the line, h^2/7, that of an even medium of half the
/// length sqrt(3/7) h.
inline constexpr const char* kSmokeCapture = R"(
uniform vec4 depthPlane; // linear depth of a relative position
uniform int layer;
void main() {
  Chord chord = chordOf();
  float h = chord.halfLength;
  if (h < 0.0) return;
  float before = eye.w != 0.0 ? max(-h, -chord.middle) : -h; // from the light on
  if (before >= h) return;
  float depth = opticalDepth(h, h) - opticalDepth(h, before);
  if (depth < 1e-4) return; // would take memory and show nowhere
  float reach = sqrt(3.0 / 7.0) * h;
  vec3 entry = chord.origin + (chord.middle + max(before, -reach)) * chord.direction;
  vec3 exit = chord.origin + (chord.middle + max(before, reach)) * chord.direction;
  tyndallCapture(ivec3(gl_FragCoord.xy, layer), dot(depthPlane.xyz, entry) + depthPlane.w,
                 dot(depthPlane.xyz, exit) + depthPlane.w, exp(-depth));
}
)";

/// Light that smoke scatters, 1/sr: a tile of kTile x kTile points for each ball, across the view. Goes behind kLights.
/// Scattering is isotropic; of the sky's light, as of surfaces, a share arrives.
inline constexpr const char* kSmokeLight = R"(
uniform samplerBuffer particles;
uniform int tilesAcross;
uniform int count;
uniform vec3 right; // across the view, length 1
uniform vec3 up;
layout(location = 0) out vec4 scattered;
const int kTile = 4;
void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int index = texel.y / kTile * tilesAcross + texel.x / kTile;
  if (index >= count) discard;
  scattered = vec4(0.3 * skyRadiance, 0.0);
  if (pass == AMBIENT) return;
  vec4 ball = texelFetch(particles, 2 * index);
  vec2 aside = (vec2(texel % kTile) + 0.5) * (2.0 / float(kTile)) - 1.0;
  vec3 position = ball.xyz + ball.w * (aside.x * right + aside.y * up);
  vec3 toLight;
  float lightDistance;
  vec3 strength = unblockedIrradiance(position, toLight, lightDistance);
  if (strength != vec3(0.0)) strength *= lightThrough(position, toLight, 0.0, toLight, 0.0, lightDistance);
  scattered = vec4(min(strength / (4.0 * kPi), maxRadiance), 0.0);
}
)";

/// The picture: radiance, to be added to what is behind times alpha. Ends at the scene's depth, so that no edge shows
/// where a ball meets a surface.
inline constexpr const char* kSmokeFragment = R"(
uniform sampler2D sceneDepth;
uniform sampler2D light;
uniform vec2 tileSize; // of the light's texture
uniform int tilesAcross;
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;     // along the view, length 1
uniform vec3 viewpoint;   // relative position of view depth 0
uniform vec2 ndcFromDepth; // scale and offset
uniform vec4 depthFromNdc; // view depth is (x ndc + y) / (z ndc + w)
layout(location = 0) out vec4 result;
void main() {
  Chord chord = chordOf();
  float h = chord.halfLength;
  if (h < 0.0) discard;
  float ndc = texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r * ndcFromDepth.x + ndcFromDepth.y;
  vec2 ratio = depthFromNdc.xz * ndc + depthFromNdc.yw;
  float advance = dot(chord.direction, forward);
  float end = (ratio.x / ratio.y - dot(chord.origin - viewpoint, forward)) / advance - chord.middle;
  if (ratio.y == 0.0) end = h; // an infinite far plane
  float begin = eye.w != 0.0 ? max(-h, -chord.middle) : -h;
  if (min(end, h) <= begin) discard;
  float passed = exp(opticalDepth(h, begin) - opticalDepth(h, min(end, h)));

  vec3 aside = (chord.origin + chord.middle * chord.direction - ball.xyz) / ball.w;
  vec2 inTile = clamp(vec2(dot(aside, right), dot(aside, up)) * 2.0 + 2.0, 0.5, 3.5);
  vec2 tile = vec2(index % tilesAcross, index / tilesAcross);
  vec3 scattered = textureLod(light, (tile * 4.0 + inTile) / tileSize, 0.0).rgb;
  result = vec4(matter.rgb * scattered * (1.0 - passed), passed);
}
)";

} // namespace host::shaders
