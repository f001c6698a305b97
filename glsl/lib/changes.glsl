// What has changed of a light's slices, to the pixels around them: for the masks of temporal reuse. Needs lib/depth.glsl, lib/slices.glsl.

uniform sampler2D changedSegments;
uniform sampler2D changedSlices;
uniform sampler2D sampleEnds;
uniform sampler2D lastDepth;
uniform sampler2D movedSlices;

const float kNoEnd = 3e38;

// Of a light of which only some slices were compared (comparesSome) no others have changed.
bool isCompared(int slice) { return comparesSome == 0 || texelFetch(movedSlices, ivec2(slice, 0), 0).g != 0.0; }

// What a slice means to the pixels from low to high: x: samples that serve them have changed; y: pixels that end behind the result are
// marched by themselves, and its row has changed; else kNoEnd.
vec2 changeOf(int slice, vec2 low, vec2 high) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  vec4 at = line.z + vec4(dot(low, line.xy), dot(vec2(high.x, low.y), line.xy), dot(vec2(low.x, high.y), line.xy), dot(high, line.xy));
  float least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  int first = int(clamp(least, 0.0, line.w)), last = int(clamp(most + 1.0, 0.0, line.w));
  float changed = 0.0, farther = 0.0;
  for (int i = first >> 4; i <= last >> 4; ++i) changed = max(changed, texelFetch(changedSegments, ivec2(slice, i), 0).r);
  if (texelFetch(changedSlices, ivec2(slice, 0), 0).a == 0.0) return vec2(changed, kNoEnd);
  if (least < 0.0 || most > line.w) return vec2(1.0, 0.0); // beside the slice's samples
  for (int i = first; i <= last; ++i) farther = max(farther, texelFetch(sampleEnds, ivec2(slice, i), 0).r);
  return vec2(changed, 1.0001 * farther);
}

bool hasDepthChanged(ivec2 pixel) {
  return floatBitsToInt(depthAt(pixel)) != floatBitsToInt(texelFetch(lastDepth, pixel, 0).r);
}
