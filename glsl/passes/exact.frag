// Exact: every shadow texel along the pixel's own ray, in every view, for one light; the reference of all techniques.
// Reads the scene depth (image size), the light's shadow map and glass map. Writes inscatter (RGB, added up over the
// lights) and, in the frame's first pass, transmittance: as the two sources of dual-source blending (COMPOSITE 1) or into
// two targets (COMPOSITE 0). LIGHT_KIND 3: no light, transmittance only. Physics: DESIGN 1; closed form of Yusov 2013.
#define FADE_STEPS 16
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#if LIGHT_KIND < 3
#include "lib/airlight.glsl"
#include "lib/shadow.glsl"
#if SHADOW_VIEWS > 0
Light ownedLight(Airlight light, ViewSegment segment, int slice) { return segmentLight(light, segment); }
#endif
#endif

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

#if DEPTH_MULTISAMPLED
const int kMaxSamples = MAX_DEPTH_SAMPLES;
#else
const int kMaxSamples = 1;
#endif

// Inscatter along the ray, as a mean over the pixel's samples: with the ends in ascending order, the stretch up to the
// k-th end belongs to all samples from k on. So no stretch is walked twice.
vec3 inscatterOf(Ray ray, float ends[kMaxSamples], int samples) {
#if LIGHT_KIND < 3
  Airlight light = airlightOf(ray);
  Light sum = Light(0.0);
  float from = 0.0;
  for (int k = 0; k < samples; ++k) {
    float s0 = from, s1 = min(ends[k], extinction.w);
    from = max(from, s1);
    litRange(light, s0, s1);
    sum += shadowedLight(light, ray, s0, s1, ivec2(0, MAX_SHADOW_VIEWS), true, 0) * (float(samples - k) / float(samples));
  }
  return min(lightColour.rgb * vec3(sum), limits.xxx);
#else
  return vec3(0.0);
#endif
}

void main() {
  float ends[kMaxSamples];
  int samples = min(counts.y, kMaxSamples);
  vec3 transmittance = vec3(0.0);
  for (int k = 0; k < samples; ++k) {
    float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy), k)), 0.0);
    transmittance += transmittanceTo(end) / float(samples);
    for (int i = 0; i < k; ++i) { // insertion sort, ascending
      float nearer = min(ends[i], end);
      end = max(ends[i], end);
      ends[i] = nearer;
    }
    ends[k] = end;
  }
  outInscatter = vec4(inscatterOf(cameraRay(gl_FragCoord.xy), ends, samples), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
}
