// Transmittance: of the stretch to the first surface, as a mean over a pixel's samples, without light. Reads the scene depth (image size).
// Writes inscatter, 0, and transmittance: as the two sources of dual-source blending (COMPOSITE 1) or into two targets.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#if EYE_CURVES
#include "lib/curveNodes.glsl"
#include "lib/eyeTexels.glsl"
#include "lib/eyeVeil.glsl"
#else
float eyeTransmittance(vec2 position, Ray ray, float s) { return 1.0; }
#endif
#include "lib/depthSamples.glsl"

#if COMPOSITE
#include "lib/outputs.glsl"
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void main() {
  vec3 transmittance = vec3(0.0);
  Ray ray = cameraRay(unjittered(gl_FragCoord.xy));
  float last = -1.0; // most of a pixel's samples end where one before them does
  vec3 passed = vec3(0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = sampleEndAt(k);
    if (end != last) passed = eyeTransmittance(unjittered(gl_FragCoord.xy), ray, end) * transmittanceTo(ray, end);
    last = end;
    transmittance += passed / float(depthSampleCount);
  }
  outInscatter = vec4(0.0);
  outTransmittance = vec4(transmittance, 1.0);
}
