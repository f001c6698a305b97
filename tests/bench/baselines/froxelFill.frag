// Froxel fill: the airlight of one light from the eye to the far side of each of seven slices, shadowed by one look-up a
// froxel, carried on from the seven before (Wronski 2014, scattering and integration in one); behind the last
// slice one layer takes the rest of the ray. Reads the light's maps and the carry.
// Writes seven layers of the volume (RGBA16F, added up over the lights) and the new carry (RGBA32F).
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"
#include "common/froxel.glsl"

uniform int firstSlice;
uniform sampler2D carry;
layout(location = 0) out vec4 outSlices[8]; // seven layers and the carry

void main() {
  vec2 shape = vec2(textureSize(carry, 0));
  Ray ray = cameraRay(gl_FragCoord.xy / shape * vec2(frameSize));
  Airlight light = airlightOf(ray);
  float low = 0.0, high = visibleEnd;
  litRange(light, low, high);
#if SHADOW_VIEWS == 1
  ViewLine line = viewLine(0, ray);
  float from = 0.0, to = 1e30;
  clipToSides(line, from, to);
#elif SHADOW_VIEWS > 1
  ViewLine line = viewLine(0, ray);
#endif
  vec3 sum = firstSlice == 0 ? vec3(0.0) : texelFetch(carry, ivec2(gl_FragCoord.xy), 0).rgb;
  float begin = boundaryAt(float(firstSlice));
  for (int i = 0; i < 7; ++i) {
    float end = firstSlice + i < slices ? boundaryAt(float(firstSlice + i + 1)) : 1e30;
    float s0 = max(begin, low), s1 = min(end, high);
    begin = end;
    Light part = Light(0.0);
#if SHADOW_VIEWS == 0
    if (s1 > s0) part = airlight(light, s0, s1);
#elif SHADOW_VIEWS == 1
    float s = 0.5 * (s0 + s1);
    if (s1 > s0 && s >= from && s <= to) part = shadowedSteps(light, line, ray, s0, s1, 1, 0.5);
    else if (s1 > s0 && isLitOutside != 0) part = airlight(light, s0, s1);
#else
    if (s1 > s0) part = shadowedSteps(light, line, ray, s0, s1, 1, 0.5);
#endif
    sum += lightColour * vec3(part);
    outSlices[i] = vec4(min(sum, vec3(65504.0)), 1.0);
  }
  outSlices[7] = vec4(sum, 1.0);
}
