// Writes a curve to the curves' texture: two nodes in a texel, or four of 16 bits for depth and transmittance each.
layout(rgba32ui, binding = 0) uniform writeonly uimage2DArray curveImage;

#if TYNDALL_CURVE_PACKED
const int kCurveTexels = TYNDALL_CURVE_NODES / 4;

uint packedNode(vec2 node) {
  uvec2 bits = uvec2(round(clamp(node, 0.0, 1.0) * 65535.0));
  return bits.x << 16u | bits.y;
}

uvec4 storedNodes(int i) {
  uvec4 nodes;
  for (int k = 0; k < 4; ++k) nodes[k] = packedNode(tyndallCurve[4 * i + k]);
  return nodes;
}
#else
const int kCurveTexels = TYNDALL_CURVE_NODES / 2;

uvec4 storedNodes(int i) { return floatBitsToUint(vec4(tyndallCurve[2 * i], tyndallCurve[2 * i + 1])); }
#endif

void storeCurve(ivec3 texel) {
  for (int i = 0; i < kCurveTexels; ++i) imageStore(curveImage, ivec3(texel.xy, texel.z * kCurveTexels + i), storedNodes(i));
}
