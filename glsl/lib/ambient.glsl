// What the medium scatters of the light of the surroundings towards the eye. Needs lib/airlight.glsl, for LIGHT_KIND 0 without a boundary.

#if EYE_CURVES
#include "lib/curveNodes.glsl"
#include "lib/weighted.glsl"
#include "lib/eyeTexels.glsl"
#include "lib/eyeCurves.glsl"
#include "lib/eyeVeil.glsl"
#endif

// Of the constituents that are the same everywhere, 0, or of those that follow a layer, 1 and 2: where density is 1, a unit of length. 3: of what
// fog before the eye takes.
vec3 ambientOf(int group, vec3 d) {
  int first = AMBIENT_TERMS * group;
  float terms[AMBIENT_TERMS] = float[](1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3.0 * d.z * d.z - 1.0, d.x * d.z, d.x * d.x - d.y * d.y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < AMBIENT_TERMS; ++i) sum += terms[i] * ambientHarmonics[first + i].rgb;
  return max(sum, vec3(0.0));
}

// Of the ray through a window position.
Airlight ambientLightOf(vec2 position) {
  Ray ray = cameraRay(position);
  Airlight light = airlightOf(ray);
#if HEIGHT
  light.phases.even = ambientOf(0, ray.direction);
  light.phases.first = ambientOf(1, ray.direction);
#if HEIGHT > 2
  light.phases.second = ambientOf(2, ray.direction);
#endif
#else
  light.phase = ambientOf(0, ray.direction);
#endif
#if EYE_CURVES
  startEyePath(position, ray);
#if FOG
  eyePath.fog = ambientOf(3, ray.direction);
#endif
#endif
  return light;
}

uniform sampler2D occlusion;

float occlusionTexel(ivec2 texel) {
  float share = texelFetch(occlusion, clamp(texel, ivec2(0), occlusionSize - 1), 0).r;
  return share >= 0.0 ? min(share, 1.0) : share < 0.0 ? 0.0 : 1.0; // 1 of what is no number
}

// What is open at a place of the picture, which is jittered.
float occlusionAt(vec2 windowPosition) {
  if (occlusionSize.x == 0) return 1.0;
  vec2 at = windowPosition / vec2(frameSize) * vec2(occlusionSize) - 0.5, f = fract(at);
  ivec2 low = ivec2(floor(at));
  return mix(mix(occlusionTexel(low), occlusionTexel(low + ivec2(1, 0)), f.x), mix(occlusionTexel(low + ivec2(0, 1)), occlusionTexel(low + 1), f.x), f.y);
}

// Of a stretch of that ray, as it comes to the eye.
void addAmbient(Airlight light, float s0, float s1, inout vec3 sum) {
#if EYE_CURVES
  addSeen(light, s0, s1, 1.0, 0.0, sum);
#else
  addAirlight(light, s0, s1, 1.0, sum);
#endif
}
