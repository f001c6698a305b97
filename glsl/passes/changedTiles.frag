// Changed tiles: of 16 x 16 pixels, those of which a pixel may not be what it was in the last frame: its own depth has changed
// (COMPARES_DEPTH 1), or a sample that serves it; or a pixel ends behind all those samples, so that it is marched by itself, and a row has
// changed. Discards the others. Reads the slice table, changedSegments, changedSlices, sampleEnds, the scene depth and the last frame's.
// Writes tiles: image size / 16, R32F: 1.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

const int kTile = 16;

uniform sampler2D changedSegments;
uniform sampler2D changedSlices;
uniform sampler2D sampleEnds;
#if COMPARES_DEPTH
uniform sampler2D lastDepth;
#endif
layout(location = 0) out vec4 outTile;

// The slices around the pixels of a tile: the first, and how many. All of them where the epipole is near.
ivec2 slicesOf(vec2 low, vec2 high) {
  vec2 middle = 0.5 * (low + high);
  if (distance(middle * epipole.z, epipole.xy) < 2.0 * float(kTile) * abs(epipole.z)) return ivec2(0, grid.x);
  vec4 at = vec4(sliceCoordinate(low), sliceCoordinate(vec2(high.x, low.y)), sliceCoordinate(vec2(low.x, high.y)), sliceCoordinate(high));
  float turn = float(grid.x), least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  if (sliceMap.w != 0.0 && most - least > 0.5 * turn) { // across the begin
    at += mix(vec4(0.0), vec4(turn), lessThan(at, vec4(0.5 * turn)));
    least = min(min(at.x, at.y), min(at.z, at.w));
    most = max(max(at.x, at.y), max(at.z, at.w));
  }
  int first = int(floor(least));
  return ivec2(first, min(int(floor(most)) + 2 - first, grid.x));
}

// True if the samples of a slice that serve pixels of a tile have changed, or pixels up to `end` may be served by none.
bool isChanged(int slice, vec2 low, vec2 high, float end) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  vec4 at = line.z + vec4(dot(low, line.xy), dot(vec2(high.x, low.y), line.xy), dot(vec2(low.x, high.y), line.xy), dot(high, line.xy));
  float least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  int first = int(clamp(least, 0.0, line.w)), last = int(clamp(most + 1.0, 0.0, line.w));
  for (int i = first >> 4; i <= last >> 4; ++i)
    if (texelFetch(changedSegments, ivec2(slice, i), 0).r > 0.0) return true;
  if (texelFetch(changedSlices, ivec2(slice, 0), 0).a == 0.0) return false;
  if (least < 0.0 || most > line.w) return true; // beside the slice's samples
  float farther = 0.0;
  for (int i = first; i <= last; ++i) farther = max(farther, texelFetch(sampleEnds, ivec2(slice, i), 0).r);
  return end > 1.0001 * farther;
}

void main() {
  ivec2 first = kTile * ivec2(gl_FragCoord.xy), last = min(first + kTile, counts.zw) - 1;
  bool changed = false;
  float end = 0.0;
  for (int y = first.y; y <= last.y && !changed; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      float depth = depthAt(ivec2(x, y), 0);
      end = max(end, min(rayEnd(vec2(x, y) + 0.5, depth), extinction.w));
#if COMPARES_DEPTH
      changed = changed || floatBitsToInt(depth) != floatBitsToInt(texelFetch(lastDepth, ivec2(x, y), 0).r);
#endif
    }
  vec2 low = vec2(first) + 0.5, high = vec2(last) + 0.5;
  ivec2 slices = slicesOf(low, high);
  for (int i = 0; i < slices.y && !changed; ++i)
    changed = isChanged(sliceMap.w != 0.0 ? (slices.x + i + grid.x) % grid.x : clamp(slices.x + i, 0, grid.x - 1), low, high, end);
  if (!changed) discard;
  outTile = vec4(1.0);
}
