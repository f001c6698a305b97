// From epipolar samples to pixels; a pixel that no sample serves is marched by itself.
// Reads samples, the scene depth and the light's maps. Writes inscatter of one light, and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"
#include "common/texelSteps.glsl"
#include "common/agreement.glsl"
#include "common/epipolar.glsl"
#include "common/unwarp.glsl"
#include "common/final.glsl"

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  vec4 sum = unwarped(gl_FragCoord.xy, end);
  vec3 inscatter = sum.rgb / max(sum.w, 1e-20);
  if (sum.w < 0.05) inscatter = lightColour * vec3(texelSteppedLight(cameraRay(gl_FragCoord.xy), end));
  writeFinal(inscatter, end);
}
