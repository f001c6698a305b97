// Fixed steps: the inscatter of one light at every pixel, jittered by interleaved gradient noise.
// Reads the scene depth and the light's maps. Writes inscatter, added up over the lights, and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"
#include "common/final.glsl"

uniform int steps;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  Light light = steppedLight(cameraRay(gl_FragCoord.xy), end, steps, gradientNoise(gl_FragCoord.xy));
  writeFinal(lightColour * vec3(light), end);
}
