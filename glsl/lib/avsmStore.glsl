// Writes a curve to the curves' texture: two nodes in a texel, or four of 16 bits for depth and transmittance each.
#if TYNDALL_CURVE_PACKED
layout(rgba32ui, binding = 0) uniform writeonly uimage2DArray curves;

uint packedNode(vec2 node) {
  uvec2 bits = uvec2(round(clamp(node, 0.0, 1.0) * 65535.0));
  return bits.x << 16u | bits.y;
}

void storeCurve(ivec3 texel) {
  const int layers = TYNDALL_CURVE_NODES / 4;
  for (int i = 0; i < layers; ++i) {
    uvec4 nodes;
    for (int k = 0; k < 4; ++k) nodes[k] = packedNode(tyndallCurve[4 * i + k]);
    imageStore(curves, ivec3(texel.xy, texel.z * layers + i), nodes);
  }
}
#else
layout(rgba32f, binding = 0) uniform writeonly image2DArray curves;

void storeCurve(ivec3 texel) {
  const int layers = TYNDALL_CURVE_NODES / 2;
  for (int i = 0; i < layers; ++i)
    imageStore(curves, ivec3(texel.xy, texel.z * layers + i), vec4(tyndallCurve[2 * i], tyndallCurve[2 * i + 1]));
}
#endif
