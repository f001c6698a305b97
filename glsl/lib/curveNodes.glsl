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

const float kLeastPassed = 1e-6; // of an even medium, which would let nothing through

// What passes up to a depth, before what is at that depth itself, as if between two nodes the same were everywhere: so that what is taken there
// changes as it does in fog, not in steps.
float curveUpTo(usampler2DArray map, int texels, int isPacked, ivec3 texel, float depth) {
  vec2 before = vec2(-1e9, 1.0);
  for (int i = 0; i < texels; ++i) {
    CurveNodes nodes = curveNodes(map, texels, isPacked, texel, i);
    vec4 d = nodes.depths, p = nodes.passed;
    if (d.w >= depth) { // between which two of them
      vec2 behind = vec2(d.x, p.x);
      if (d.x < depth) { before = vec2(d.x, p.x); behind = vec2(d.y, p.y); }
      if (d.y < depth) { before = vec2(d.y, p.y); behind = vec2(d.z, p.z); }
      if (d.z < depth) { before = vec2(d.z, p.z); behind = vec2(d.w, p.w); }
      float share = clamp((depth - before.x) / max(behind.x - before.x, 1e-30), 0.0, 1.0);
      return behind.y > kLeastPassed ? before.y * pow(behind.y / before.y, share) : mix(before.y, behind.y, share);
    }
    before = vec2(d.w, p.w);
  }
  return before.y;
}

// Adds the part of the line from node a to node b (depth, transmittance) between two depths to an integral and a first moment.
void addLine(vec2 a, vec2 b, float low, float high, inout vec2 sum) {
  float from = clamp(a.x, low, high), to = clamp(b.x, low, high);
  if (!(to > from)) return;
  float slope = (b.y - a.y) / (b.x - a.x), halfLength = 0.5 * (high - low), middle = 0.5 * (low + high);
  float va = a.y + slope * (from - a.x), vb = a.y + slope * (to - a.x);
  float xa = (from - middle) / halfLength, xb = (to - middle) / halfLength;
  sum += (to - from) * vec2(0.5 * (va + vb), (va * xa + (va + vb) * (xa + xb) + vb * xb) / 6.0);
}

// Mean transmittance between two depths, low < high, and its first moment (from -1 to 1).
vec2 curveBetween(usampler2DArray map, int texels, int isPacked, ivec3 texel, float low, float high) {
  vec2 sum = vec2(0.0), before = vec2(-1e9, 1.0);
  for (int i = 0; i < texels && before.x < high; ++i) {
    CurveNodes nodes = curveNodes(map, texels, isPacked, texel, i);
    for (int k = 0; k < 4; ++k) {
      vec2 node = vec2(nodes.depths[k], nodes.passed[k]);
      addLine(before, node, low, high, sum);
      before = node;
    }
  }
  addLine(before, vec2(1e9, before.y), low, high, sum);
  return sum / (high - low);
}
