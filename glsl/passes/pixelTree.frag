// Pixel tree: every pixel, or every pixel that unwarp left, through the tree of its nearest slice (Chen 2011); one light,
// the shadow views of a draw. Reads the scene depth, slice table and row textures; LOW_RANK 1: lowRankRays, lowRankLights. Writes as exact.frag does.
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

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy), 0)), 0.0);
  int slice = neighbourSlices(sliceCoordinate(gl_FragCoord.xy) + 0.5).x;
#ifdef LOW_RANK
  startLowRank(cameraRay(gl_FragCoord.xy), slice);
#endif
  vec3 light = vec3(rowShadowedLight(cameraRay(gl_FragCoord.xy), 0.0, end, slice));
#ifdef COUNT_VISITS
  outInscatter = vec4(visits);
#else
  outInscatter = vec4(min(lightColour.rgb * light, limits.xxx), 0.0);
#endif
  outTransmittance = vec4(transmittanceTo(end), 1.0);
}
