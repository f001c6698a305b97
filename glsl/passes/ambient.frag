// Ambient: light of the surroundings that the medium scatters, on the stretch to the first surface, as a mean over a pixel's samples; and
// the stretch's transmittance. Reads the scene depth (image size) and occlusion (any size), the share of that light that a pixel gets.
// Writes inscatter and transmittance: as the two sources of dual-source blending (COMPOSITE 1) or into two targets.
// What a phase function leaves of spherical harmonics is spherical harmonics, each times a number (optics/Ambient.cpp): along a ray it is
// constant, as what is scattered of a directional light, LIGHT_KIND 0, that no boundary dims.
#define NO_BOUNDARY
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depthSamples.glsl"
#include "lib/airlight.glsl"
#include "lib/ambient.glsl"

#if COMPOSITE
#include "lib/outputs.glsl"
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void main() {
  vec3 transmittance = vec3(0.0), sum = vec3(0.0);
  Ray ray = cameraRay(unjittered(gl_FragCoord.xy));
  Airlight light = ambientLightOf(unjittered(gl_FragCoord.xy));
  float last = -1.0; // most of a pixel's samples end where one before them does
  vec3 passed = vec3(0.0), own = vec3(0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = sampleEndAt(k);
    if (end != last) {
      passed = transmittanceTo(ray, end);
#if EYE_CURVES
      passed *= eyeTransmittance(unjittered(gl_FragCoord.xy), ray, end);
#endif
      own = vec3(0.0);
      addAmbient(light, 0.0, min(end, visibleEnd), own);
      last = end;
    }
    transmittance += passed / float(depthSampleCount);
    sum += own / float(depthSampleCount);
  }
  outInscatter = vec4(occlusionAt(gl_FragCoord.xy) * min(ambientScale * sum, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
}
