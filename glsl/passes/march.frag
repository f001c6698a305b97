// March: inscatter of one light, through the shadow views of a draw, at the regular march samples, the first of each segment: along
// the slice's row and its tree. Reads slice table, sampleEnds, row textures. Writes marched: slices x segments, light as
// lib/stored.glsl says, R32F (grey) or RGBA16F; added up over the draws. CHANGED: only changedSegments.
#define ROW_CURVES
#define PHASE_APART
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/row.glsl"

uniform sampler2D sampleEnds;
#ifdef CHANGED
uniform sampler2D changedSegments;
#endif
layout(location = 0) out vec4 outInscatter;

void main() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice), index = 16 * int(gl_FragCoord.y);
  float end = index < samples ? texelFetch(sampleEnds, ivec2(slice, index), 0).r : 0.0;
#ifdef CHANGED
  bool changed = index < samples && texelFetch(changedSegments, ivec2(slice, index / 16), 0).r > 0.0;
  if (!changed) end = 0.0; // no walk
#endif
  Ray ray = cameraRay(samplePosition(sliceEnds(slice), samples, float(index)));
#ifdef CHANGED
  if (!changed) discard;
#endif
  outInscatter = vec4(storedLight(rowShadowedLight(ray, 0.0, max(end, 0.0), slice), ray), 0.0);
}
