// Ambient: light of the surroundings that the medium scatters, on the stretch to the first surface, as a mean over a pixel's samples; and
// the stretch's transmittance. Reads the scene depth (image size) and occlusion (any size), the share of that light that a pixel gets.
// Writes inscatter and transmittance: as the two sources of dual-source blending (COMPOSITE 1) or into two targets.
// What a phase function leaves of spherical harmonics is spherical harmonics, each times a number (optics/Ambient.cpp): along a ray it is
// constant, as what is scattered of a directional light, LIGHT_KIND 0, that no boundary dims.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depthSamples.glsl"
#include "lib/airlight.glsl"
#include "lib/ambient.glsl"

uniform sampler2D occlusion;
#if COMPOSITE
#include "lib/outputs.glsl"
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

float shareAt(ivec2 texel) {
  float share = texelFetch(occlusion, clamp(texel, ivec2(0), occlusionSize - 1), 0).r;
  return share >= 0.0 ? min(share, 1.0) : share < 0.0 ? 0.0 : 1.0;
}

float openShare() {
  if (occlusionSize.x == 0) return 1.0;
  vec2 at = gl_FragCoord.xy / vec2(frameSize) * vec2(occlusionSize) - 0.5, f = fract(at);
  ivec2 low = ivec2(floor(at));
  return mix(mix(shareAt(low), shareAt(low + ivec2(1, 0)), f.x), mix(shareAt(low + ivec2(0, 1)), shareAt(low + 1), f.x), f.y);
}

void main() {
  vec3 transmittance = vec3(0.0), sum = vec3(0.0);
  Ray ray = cameraRay(unjittered(gl_FragCoord.xy));
  Airlight light = ambientLightOf(ray);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = sampleEndAt(k);
    transmittance += transmittanceTo(ray, end) / float(depthSampleCount);
    addAirlight(light, 0.0, min(end, visibleEnd), 1.0 / float(depthSampleCount), sum);
  }
  outInscatter = vec4(openShare() * min(sum, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
}
