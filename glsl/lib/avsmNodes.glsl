// Nodes of a curve in a texel of the curves' texture: two, or four of 16 bits for depth and transmittance each. Needs lib/avsmCurve.
#if TYNDALL_CURVE_PACKED
const int kTyndallNodesOfTexel = 4;

uvec4 tyndallTexelFrom(int first) {
  uvec4 texel;
  for (int i = 0; i < 4; ++i) {
    uvec2 bits = uvec2(round(clamp(tyndallCurve[first + i], 0.0, 1.0) * 65535.0));
    texel[i] = bits.x << 16u | bits.y;
  }
  return texel;
}

void tyndallTakeTexel(int first, uvec4 texel) {
  for (int i = 0; i < 4; ++i) tyndallCurve[first + i] = vec2(texel[i] >> 16u, texel[i] & 0xFFFFu) * (1.0 / 65535.0);
}
#else
const int kTyndallNodesOfTexel = 2;

uvec4 tyndallTexelFrom(int first) { return floatBitsToUint(vec4(tyndallCurve[first], tyndallCurve[first + 1])); }

void tyndallTakeTexel(int first, uvec4 texel) {
  tyndallCurve[first] = uintBitsToFloat(texel.xy);
  tyndallCurve[first + 1] = uintBitsToFloat(texel.zw);
}
#endif
const int kTyndallTexelsOfCurve = TYNDALL_CURVE_NODES / kTyndallNodesOfTexel;

// Counts the nodes of a curve whose texels were taken, as tyndallPadCurve() left them.
void tyndallFindUsed() {
  tyndallUsed = TYNDALL_CURVE_NODES;
  for (int i = TYNDALL_CURVE_NODES - 1; i > 0; --i)
    if (tyndallUsed == i + 1 && tyndallCurve[i] == tyndallCurve[i - 1]) tyndallUsed = i;
  if (tyndallUsed == 1 && tyndallCurve[0] == vec2(1.0)) tyndallUsed = 0;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i].x = i < tyndallUsed ? tyndallCurve[i].x : kTyndallUnused;
}
