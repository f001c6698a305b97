// Deep shadow map: the nodes around a depth by bisection, a line between them.
layout(std430, binding = 3) readonly buffer Nodes {
  uint nodesReserved, nodesUsed;
  vec2 nodes[];
};
layout(std430, binding = 4) readonly buffer Texels { uvec2 texels[]; };

float transmittanceAt(ivec2 texel, float depth) {
  uvec2 own = texels[texel.y * mapSize + texel.x];
  if (own.y == 0u) return 1.0;
  uint low = 0u, high = own.y; // of nodes before low none lies behind the depth, from high on all do
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (nodes[own.x + middle].x <= depth) low = middle + 1u;
    else high = middle;
  }
  if (low == 0u) return 1.0;
  vec2 before = nodes[own.x + low - 1u];
  if (low == own.y) return before.y;
  vec2 behind = nodes[own.x + low];
  return mix(before.y, behind.y, (depth - before.x) / (behind.x - before.x));
}
