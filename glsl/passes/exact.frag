// Exact: every shadow texel along the pixel's own ray, in every view, for one light; the reference of all techniques.
// Reads the scene depth (image size), the light's shadow map and glass map. Writes inscatter (RGB, added up over the
// lights) and transmittance, as the two sources of dual-source blending: the second counts only where it is blended by.
// Physics: DESIGN 1; closed form of Yusov 2013.
#define FADE_STEPS 16
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depthSamples.glsl"
#include "lib/airlight.glsl"
#include "lib/shadow.glsl"
#if SHADOW_VIEWS > 0
Light ownedLight(Airlight light, ViewSegment segment, int slice) { return segmentLight(light, segment); }
#endif

#include "lib/outputs.glsl"

// Of a pixel's samples: where the first of those ends that end behind `from`, and how many do.
vec2 nextEnd(float from) {
  vec2 next = vec2(3e38, 0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = min(sampleEndAt(gl_FragCoord.xy, k), visibleEnd);
    if (end > from) next = vec2(min(next.x, end), next.y + 1.0);
  }
  return next;
}

// Inscatter along the ray, as a mean over the pixel's samples: the stretch up to the next end belongs to all samples that
// end there or behind. So no stretch is walked twice.
vec3 inscatterOf(Ray ray) {
  Airlight light = airlightOf(ray);
  Light sum = Light(0.0);
  float from = 0.0;
  for (int k = 0; k < depthSampleCount; ++k) {
    vec2 next = nextEnd(from);
    if (next.y == 0.0) break;
    float s0 = from, s1 = next.x;
    from = s1;
    litRange(light, s0, s1);
    sum += shadowedLight(light, ray, s0, s1, ivec2(0, MAX_SHADOW_VIEWS), true, 0) * (next.y / float(depthSampleCount));
  }
  return min(lightColour * vec3(sum), vec3(lightCeiling));
}

void main() {
  vec3 transmittance = vec3(0.0);
  for (int k = 0; k < depthSampleCount; ++k)
    transmittance += transmittanceTo(sampleEndAt(gl_FragCoord.xy, k)) / float(depthSampleCount);
  outInscatter = vec4(inscatterOf(cameraRay(gl_FragCoord.xy)), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
}
