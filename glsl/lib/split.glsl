// What a node of a row's tree says of its texels' depths (coded), beyond their bounds: lowest, before, behind, highest.
// No depth lies between `before` and `behind`, so that for a receiver there some texels are lit all along and the others
// dark: the node's average is the share of lit texels and the first moment of it over the node, from -1 to 1.

const vec4 kNoSplit = vec4(3.4e38, 3.4e38, -3.4e38, -3.4e38); // 1, 1, 0, 0 where depths are stored in 16 bits

vec4 storedAverage(vec2 average) { return vec4(average.x, 0.5 * average.y + 0.5, 0.0, 0.0); }
vec2 averageOf(vec4 stored) { return vec2(stored.x, 2.0 * stored.y - 1.0); }

// Where to split: halfway between the bounds; what holds no caster counts as at the far plane.
float splitOf(float lowest, float highest) {
  float far = viewDepth[march.x].y * rowCode.x + rowCode.y;
  return 0.5 * (lowest + min(highest, max(far, lowest)));
}
