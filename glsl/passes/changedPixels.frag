// Changed pixels: those that may not be what they were in the last frame, as changedTiles.frag has it for tiles. Discards the others, so
// that the stencil keeps these. Reads the slice table, changedSegments, changedSlices, sampleEnds, the scene depth and the last frame's.
// Adds nothing to inscatter (image size), which is drawn anew there.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"
#include "lib/changes.glsl"

layout(location = 0) out vec4 outInscatter;

void main() {
  vec2 position = unjittered(gl_FragCoord.xy);
  ivec2 pixel = ivec2(gl_FragCoord.xy), slices = neighbourSlices(sliceCoordinate(position));
  bool compared = false, changed = false;
  float alone = kNoEnd;
  for (int i = 0; i < 2; ++i) {
    int slice = i == 0 ? slices.x : slices.y;
    if (!isCompared(slice)) continue;
    vec2 change = changeOf(slice, position, position);
    compared = true;
    changed = changed || change.x > 0.0;
    alone = min(alone, change.y);
  }
  if (!changed && compared && comparesDepth != 0) changed = hasDepthChanged(pixel);
  if (!changed && alone < kNoEnd) changed = min(rayEnd(position, depthAt(pixel)), visibleEnd) > alone;
  if (!changed) discard;
  outInscatter = vec4(0.0);
}
