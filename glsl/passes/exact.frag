// Exact: every shadow texel along the pixel's own ray, in every view, for one light; the reference of all techniques.
// Reads the scene depth (image size), the light's shadow map and glass map. Writes inscatter (RGB, added up over the
// lights) and transmittance (lib/outputs.glsl).
// Physics: DESIGN 1; closed form of Yusov 2013.
#define FADE_STEPS 16
#define FOG_STEPS (FILTER_BILINEAR == 1 && GLASS == 1 ? 64.0 : 128.0) // llvmpipe ends all loops after 65,535 turns
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depthSamples.glsl"
#include "lib/airlight.glsl"
#include "lib/shadow.glsl"
#if SHADOW_VIEWS > 0
void addOwned(Airlight light, ViewSegment segment, int slice, inout Light sum) { addTexels(light, segment, sum); }
#endif

#include "lib/outputs.glsl"

// Of a pixel's samples: where the first of those ends that end behind `from`, and how many do.
vec2 nextEnd(float from) {
  vec2 next = vec2(3e38, 0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = min(sampleEndAt(k), visibleEnd);
    if (end > from) next = vec2(min(next.x, end), next.y + 1.0);
  }
  return next;
}

vec3 meanTransmittance() {
  vec3 sum = vec3(0.0);
  Ray ray = cameraRay(unjittered(gl_FragCoord.xy));
  for (int k = 0; k < depthSampleCount; ++k) sum += transmittanceTo(ray, sampleEndAt(k)) / float(depthSampleCount);
  return sum;
}

// As a mean over the pixel's samples: the stretch up to the next end belongs to all samples that end there or behind. So no
// stretch is walked twice.
void main() {
  Light sum = Light(0.0);
  float from = 0.0;
  for (int k = 0; k < depthSampleCount; ++k) {
    vec2 next = nextEnd(from);
    if (next.y == 0.0) break;
    sum += shadowedLight(unjittered(gl_FragCoord.xy), from, next.x, ivec2(0, MAX_SHADOW_VIEWS), true, 0) * (next.y / float(depthSampleCount));
    from = next.x;
  }
  outInscatter = vec4(min(lightColour * vec3(sum), vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(meanTransmittance(), 1.0);
}
