// Changed tiles: of 16 x 16 pixels, those of which a pixel may not be what it was in the last frame: its own depth has changed
// (comparesDepth), or a sample that serves it; or a pixel ends behind all those samples, so that it is marched by itself, and a row has
// changed. Discards the others. Reads the slice table, changedSegments, changedSlices, sampleEnds, the scene depth and the last frame's.
// In a light of which only some slices were compared (comparesSome: movedSlices) the depth of other tiles has not changed.
// Writes tiles, one after the other in lines of 256, R32F: 1.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"
#include "lib/changes.glsl"

const int kTile = 16;

layout(location = 0) out vec4 outTile;

// The slices around the pixels of a tile: the first, and how many. All of them where the epipole is near.
ivec2 slicesOf(vec2 low, vec2 high) {
  vec2 middle = 0.5 * (low + high);
  if (distance(middle * epipole.z, epipole.xy) < 2.0 * float(kTile) * abs(epipole.z)) return ivec2(0, sliceCount);
  vec4 at = vec4(sliceCoordinate(low), sliceCoordinate(vec2(high.x, low.y)), sliceCoordinate(vec2(low.x, high.y)), sliceCoordinate(high));
  float turn = float(sliceCount), least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  if (slicesClosed != 0 && most - least > 0.5 * turn) { // across the begin
    at += mix(vec4(0.0), vec4(turn), lessThan(at, vec4(0.5 * turn)));
    least = min(min(at.x, at.y), min(at.z, at.w));
    most = max(max(at.x, at.y), max(at.z, at.w));
  }
  int first = int(floor(least));
  return ivec2(first, min(int(floor(most)) + 2 - first, sliceCount));
}

float farthestEnd(ivec2 first, ivec2 last) {
  float end = 0.0;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) end = max(end, min(rayEnd(unjittered(vec2(x, y) + 0.5), depthAt(ivec2(x, y))), visibleEnd));
  return end;
}

void main() {
  int across = (frameSize.x + kTile - 1) / kTile, tile = int(gl_FragCoord.x) + 256 * int(gl_FragCoord.y);
  ivec2 first = kTile * ivec2(tile % across, tile / across), last = min(first + kTile, frameSize) - 1;
  if (first.y >= frameSize.y) discard;
  vec2 low = unjittered(vec2(first) + 0.5), high = unjittered(vec2(last) + 0.5);
  ivec2 slices = slicesOf(low, high);
  bool changed = false, compared = false;
  float alone = kNoEnd;
  for (int i = 0; i < slices.y && !changed; ++i) {
    int slice = wrapped(slices.x + i, sliceCount);
    if (!isCompared(slice)) continue;
    vec2 change = changeOf(slice, low, high);
    compared = true;
    changed = change.x > 0.0;
    alone = min(alone, change.y);
  }
  for (int y = first.y; comparesDepth != 0 && y <= last.y && compared && !changed; ++y)
    for (int x = first.x; x <= last.x; ++x)
      changed = changed || hasDepthChanged(ivec2(x, y));
  if (!changed && alone < kNoEnd) changed = farthestEnd(first, last) > alone;
  if (!changed) discard;
  outTile = vec4(1.0);
}
