// March at half resolution: inscatter of one light for 2 x 2 pixels, towards their nearest or farthest depth in a
// checkerboard, so that both sides of an edge find a partner. Reads the scene depth and the light's maps.
// Writes inscatter (RGBA16F, added up over the lights) and, with the first light, the distance marched (R32F).
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"

uniform int steps;
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out float outEnd;

float endAt(ivec2 pixel) {
  pixel = min(pixel, frameSize - 1);
  return max(rayEnd(vec2(pixel) + 0.5, depthAt(pixel)), 0.0);
}

void main() {
  ivec2 half_ = ivec2(gl_FragCoord.xy), pixel = 2 * half_;
  vec4 ends = vec4(endAt(pixel), endAt(pixel + ivec2(1, 0)), endAt(pixel + ivec2(0, 1)), endAt(pixel + ivec2(1, 1)));
  vec2 low = min(ends.xy, ends.zw), high = max(ends.xy, ends.zw);
  float end = ((half_.x + half_.y) & 1) == 0 ? min(low.x, low.y) : max(high.x, high.y);
  Light light = steppedLight(cameraRay(2.0 * gl_FragCoord.xy), end, steps, gradientNoise(gl_FragCoord.xy));
  outInscatter = vec4(min(lightColour * vec3(light), vec3(65504.0)), 1.0);
  outEnd = end;
}
