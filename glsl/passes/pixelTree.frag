// Pixel tree: every pixel through the tree of its nearest slice, as march.frag does, by low rank (Chen 2011) or counting what it looks at;
// one light, the shadow views of a draw. Reads the scene depth, slice table and row textures; LOW_RANK 1: lowRankRays, lowRankLights. Writes as exact.frag does.
#define ROW_CURVES
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#ifdef LOW_RANK
#include "lib/lowRank.glsl"
#endif
#include "lib/shadow.glsl"
#ifdef TINT_SUMS
#include "lib/tintSums.glsl"
#endif
#include "lib/tree.glsl"
#include "lib/row.glsl"

#include "lib/outputs.glsl"

void main() {
  vec2 position = unjittered(gl_FragCoord.xy);
  float end = max(rayEnd(position, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  int slice = nearestSlice(sliceCoordinate(position));
#ifdef LOW_RANK
  startLowRank(cameraRay(position), slice);
#endif
  vec3 light = vec3(rowShadowedLight(position, 0.0, end, slice));
#ifdef LOW_RANK
  light = withinUnshadowed(light, cameraRay(position), end);
#endif
#ifdef COUNT_VISITS
  outInscatter = vec4(visits);
#else
  outInscatter = vec4(min(lightColour * light, vec3(lightCeiling)), 0.0);
#endif
  outTransmittance = vec4(transmittanceTo(cameraRay(position), end), 1.0);
}
