#version 430 core
#define TYNDALL_CURVE_NODES 8
#define TYNDALL_CURVE_PACKED 0
#define TYNDALL_CURVE_EXPONENTIAL 1
// Look-up: how much of a light reaches a depth, from the curves of an adaptive volumetric shadow map (Salvi et al. 2013, 3.3 and 4.2;

#ifndef TYNDALL_CURVE_EXPONENTIAL
#define TYNDALL_CURVE_EXPONENTIAL 0
#endif

#if TYNDALL_CURVE_PACKED
const int kTyndallNodesPerTexel = 4;
#else
const int kTyndallNodesPerTexel = 2;
#endif
const int kTyndallCurveLayers = TYNDALL_CURVE_NODES / kTyndallNodesPerTexel;

#if TYNDALL_CURVE_PACKED
void tyndallNodes(usampler2DArray curves, ivec3 texel, out vec4 depths, out vec4 passed) {
  uvec4 nodes = texelFetch(curves, texel, 0);
  depths = vec4(nodes >> 16u) * (1.0 / 65535.0);
  passed = vec4(nodes & 0xFFFFu) * (1.0 / 65535.0);
}
#else
void tyndallNodes(usampler2DArray curves, ivec3 texel, out vec2 depths, out vec2 passed) {
  vec4 nodes = uintBitsToFloat(texelFetch(curves, texel, 0));
  depths = nodes.xz;
  passed = nodes.yw;
}
#endif

float tyndallBetween(vec2 a, vec2 b, float depth) {
  float share = clamp((depth - a.x) / max(b.x - a.x, 1e-9), 0.0, 1.0); // 1e-9: two nodes at one depth are a step
#if TYNDALL_CURVE_EXPONENTIAL
  return a.y * pow(max(b.y, 1e-7) / max(a.y, 1e-7), share);
#else
  return mix(a.y, b.y, share);
#endif
}

float tyndallTransmittance(usampler2DArray curves, ivec3 texel, float depth) {
  vec2 before = vec2(0.0, 1.0);
  for (int i = 0; i < kTyndallCurveLayers; ++i) {
#if TYNDALL_CURVE_PACKED
    vec4 d, t;
#else
    vec2 d, t;
#endif
    tyndallNodes(curves, ivec3(texel.xy, texel.z * kTyndallCurveLayers + i), d, t);
    if (i == 0) {
      if (depth < d.x) return 1.0; // no dimming before the first node, which stands at 1
      before = vec2(d.x, t.x);
    }
#if TYNDALL_CURVE_PACKED
    if (i + 1 < kTyndallCurveLayers && depth >= d.w) {
      before = vec2(d.w, t.w);
      continue;
    }
    vec2 a = depth < d.x ? before : depth < d.y ? vec2(d.x, t.x) : depth < d.z ? vec2(d.y, t.y) : vec2(d.z, t.z);
    vec2 b = depth < d.x ? vec2(d.x, t.x) : depth < d.y ? vec2(d.y, t.y) : depth < d.z ? vec2(d.z, t.z) : vec2(d.w, t.w);
#else
    if (i + 1 < kTyndallCurveLayers && depth >= d.y) {
      before = vec2(d.y, t.y);
      continue;
    }
    vec2 a = depth < d.x ? before : vec2(d.x, t.x), b = depth < d.x ? vec2(d.x, t.x) : vec2(d.y, t.y);
#endif
    return depth >= b.x ? b.y : tyndallBetween(a, b, depth);
  }
  return 1.0;
}

float tyndallTransmittanceBilinear(usampler2DArray curves, vec2 place, int layer, float depth) {
  ivec2 size = textureSize(curves, 0).xy;
  vec2 at = place * vec2(size) - 0.5, f = fract(at);
  ivec2 low = clamp(ivec2(floor(at)), ivec2(0), size - 1), high = clamp(ivec2(floor(at)) + 1, ivec2(0), size - 1);
  vec2 bottom = vec2(tyndallTransmittance(curves, ivec3(low, layer), depth), tyndallTransmittance(curves, ivec3(high.x, low.y, layer), depth));
  vec2 top = vec2(tyndallTransmittance(curves, ivec3(low.x, high.y, layer), depth), tyndallTransmittance(curves, ivec3(high, layer), depth));
  return mix(mix(bottom.x, bottom.y, f.x), mix(top.x, top.y, f.x), f.y);
}
uniform usampler2DArray curves;
void main() { gl_Position = vec4(tyndallTransmittanceBilinear(curves, vec2(0.5), 0, 0.5) + tyndallTransmittance(curves, ivec3(0), 0.5)); }
