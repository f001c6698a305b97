// The curves of an adaptive volumetric shadow map, as they stand in its texture (glsl/public/avsmLookup.glsl): of so many texels each, packed
// or not.

struct CurveNodes {
  vec4 depths, passed; // nearest first; the last one again where a texel holds only two
};

CurveNodes curveNodes(usampler2DArray map, int texels, int isPacked, ivec3 texel, int i) {
  uvec4 stored = texelFetch(map, ivec3(texel.xy, texel.z * texels + i), 0);
  if (isPacked != 0) return CurveNodes(vec4(stored >> 16u) * (1.0 / 65535.0), vec4(stored & 0xFFFFu) * (1.0 / 65535.0));
  vec4 nodes = uintBitsToFloat(stored);
  return CurveNodes(nodes.xzzz, nodes.ywww);
}

// Where a curve begins to fall, where it ends, and what passes from there on.
vec3 curveEnds(usampler2DArray map, int texels, int isPacked, ivec3 texel) {
  CurveNodes last = curveNodes(map, texels, isPacked, texel, texels - 1);
  return vec3(curveNodes(map, texels, isPacked, texel, 0).depths.x, last.depths.w, last.passed.w);
}

const float kLeastPassed = 1e-6; // of an even medium, which would let nothing through: behind it what passes falls along a line

// Adds the part of the line from node a to node b (depth, transmittance) between two depths to an integral and a first moment.
void addLine(vec2 a, vec2 b, float low, float high, inout vec2 sum) {
  float from = clamp(a.x, low, high), to = clamp(b.x, low, high);
  if (!(to > from)) return;
  float slope = (b.y - a.y) / (b.x - a.x), halfLength = 0.5 * (high - low), middle = 0.5 * (low + high);
  float va = a.y + slope * (from - a.x), vb = a.y + slope * (to - a.x);
  float xa = (from - middle) / halfLength, xb = (to - middle) / halfLength;
  sum += (to - from) * vec2(0.5 * (va + vb), (va * xa + (va + vb) * (xa + xb) + vb * xb) / 6.0);
}

// A part of a curve: mean transmittance and its first moment (from -1 to 1), as lines between nodes have it; and what passes up to three depths, before what
// is at those depths themselves, as if between two nodes the same were everywhere: so that what is taken there changes as it does in fog, not in steps.
struct CurvePart {
  vec2 passed;
  vec3 upTo;
};

// From one depth to another, low < high but where only the latter is asked for, and up to depths that are no less than low and no more than high. All nodes of
// the texels before `first` are nearer than low; as it is left, nearer than high: only the texels are read in which the part lies, and the one before.
CurvePart curvePart(usampler2DArray map, int texels, int isPacked, ivec3 texel, float low, float high, vec3 depths, inout int first) {
  vec2 sum = vec2(0.0), before = vec2(-1e9, 1.0);
  if (first > 0) {
    CurveNodes last = curveNodes(map, texels, isPacked, texel, first - 1);
    before = vec2(last.depths.w, last.passed.w);
  }
  vec3 fall = vec3(log2(max(before.y, 1e-30))), rest = vec3(1.0); // of what passes up to the depths: where something comes through, and where nothing does
  for (int i = first; i < texels && before.x < high; ++i) {
    CurveNodes nodes = curveNodes(map, texels, isPacked, texel, i);
    first = i;
    for (int k = 0; k < 4; ++k) {
      vec2 node = vec2(nodes.depths[k], nodes.passed[k]);
      addLine(before, node, low, high, sum);
      vec3 share = clamp((depths - before.x) * (1.0 / max(node.x - before.x, 1e-30)), 0.0, 1.0);
      if (node.y > kLeastPassed) fall += share * log2(node.y / max(before.y, kLeastPassed));
      else rest -= share;
      before = node;
    }
  }
  addLine(before, vec2(1e9, before.y), low, high, sum);
  return CurvePart(sum / (high - low), exp2(fall) * max(rest, 0.0));
}

// The first of these alone, and the second.
vec2 curveBetween(usampler2DArray map, int texels, int isPacked, ivec3 texel, float low, float high) {
  int first = 0;
  return curvePart(map, texels, isPacked, texel, low, high, vec3(low), first).passed;
}
float curveUpTo(usampler2DArray map, int texels, int isPacked, ivec3 texel, float depth) {
  int first = 0;
  return curvePart(map, texels, isPacked, texel, depth, depth, vec3(depth), first).upTo.x;
}
