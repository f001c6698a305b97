// A curve of at most ROOM nodes, of which NODES are to be kept: depth and transmittance, nearest first. All indices are static once loops are
// unrolled, so that it stays in registers (Salvi 2013, 4.2).

vec2 curve[ROOM];
int used = 0;

// Change of the integral, twice, when a node is removed (Salvi 2013, 3.2.1).
float areaOf(vec2 a, vec2 b, vec2 c) { return abs((c.x - a.x) * (c.y - b.y) - (c.x - b.x) * (c.y - a.y)); }

// Removes the inner node that changes the curve's integral least. The first and the last one stay.
void removeCheapest() {
  float least = 3e38;
  int cheapest = 1;
  for (int i = 1; i < ROOM - 1; ++i) {
    float area = areaOf(curve[i - 1], curve[i], curve[i + 1]);
    if (i < used - 1 && area < least) {
      least = area;
      cheapest = i;
    }
  }
  for (int i = 1; i < ROOM - 1; ++i)
    if (i >= cheapest) curve[i] = curve[i + 1];
  --used;
}

// Fills what is left behind the last node with copies of it.
void padCurve() {
  vec2 last = used == 0 ? vec2(1.0) : vec2(0.0);
  for (int i = 0; i < NODES; ++i) {
    if (i < used) last = curve[i];
    else curve[i] = last;
  }
}

layout(rgba32ui, binding = 0) uniform writeonly uimage2DArray curveImage;

#if PACKED
const int kTexels = NODES / 4;

uint packedNode(vec2 node) {
  uvec2 bits = uvec2(round(clamp(node, 0.0, 1.0) * 65535.0));
  return bits.x << 16u | bits.y;
}
uvec4 storedNodes(int i) { return uvec4(packedNode(curve[4 * i]), packedNode(curve[4 * i + 1]), packedNode(curve[4 * i + 2]), packedNode(curve[4 * i + 3])); }
#else
const int kTexels = NODES / 2;

uvec4 storedNodes(int i) { return floatBitsToUint(vec4(curve[2 * i], curve[2 * i + 1])); }
#endif

void storeCurve(ivec3 texel) {
  for (int i = 0; i < kTexels; ++i) imageStore(curveImage, ivec3(texel.xy, texel.z * kTexels + i), storedNodes(i));
}
