// Fix-up: the pixels that unwarp left, each along its own line, with the pair tree of the slices on both sides of it; one
// light, the shadow views of a draw. Reads the scene depth, slice table, pairTree (as rowTree) and shadow map. Writes as exact.frag does.
#define SKIPS_NODES
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/trueLine.glsl"
#include "lib/row.glsl"

#include "lib/outputs.glsl"

void main() {
  vec2 position = unjittered(gl_FragCoord.xy);
  float end = max(rayEnd(position, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  int slice = neighbourSlices(sliceCoordinate(position)).x;
  vec3 light = vec3(rowShadowedLight(position, 0.0, end, slice));
  outInscatter = vec4(min(lightColour * light, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(cameraRay(position), end), 1.0);
}
