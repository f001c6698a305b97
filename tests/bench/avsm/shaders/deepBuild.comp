// Deep shadow map (Lokovic and Veach 2000, 3.3): each texel's curve by as few lines as stay within a threshold of it, found greedily from the
// light on. Reads the lists, sorted both ways. Writes nodes, and per texel the first and their number.
#include "lib/avsm.glsl"
#include "lib/avsmWalk.glsl"

layout(std430, binding = 3) buffer Nodes {
  uint nodesReserved, nodesUsed;
  vec2 nodes[]; // depth and transmittance
};
layout(std430, binding = 4) writeonly buffer Texels { uvec2 texels[]; };
uniform float threshold;

uint first, count = 0u;

void emit(vec2 node) { nodes[first + count++] = node; }

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  uint list = listOf(texel);
  texels[list] = uvec2(0u);
  if (tyndallLists[list].count == 0u) return;
  // The walk stops at each end once more and, where the curve bends, 4 times an optical depth of 1 besides. One more each for start and end.
  first = atomicAdd(nodesReserved, 2u * tyndallLists[list].count + 4u * uint(kOpaque) + 4u);
  Walk walk = startWalk(list);
  vec2 start = nodeOf(walk), last = start, slopes = vec2(-3e38, 3e38);
  emit(start);
  while (!isOver(walk) && nextNode(walk)) {
    vec2 node = nodeOf(walk);
    if (node.x > start.x) {
      vec2 own = (node.y + vec2(-threshold, threshold) - start.y) / (node.x - start.x);
      if (own.x > slopes.y || own.y < slopes.x) { // no line from the start passes here and where the last ones did
        if (last.x > start.x) {
          start = vec2(last.x, start.y + 0.5 * (slopes.x + slopes.y) * (last.x - start.x));
          emit(start);
        }
        slopes = vec2(-3e38, 3e38);
        if (node.x > start.x) own = (node.y + vec2(-threshold, threshold) - start.y) / (node.x - start.x);
      }
      slopes = vec2(max(slopes.x, own.x), min(slopes.y, own.y));
    }
    if (node.x <= start.x && node.y != start.y) { // a step
      start = node;
      emit(start);
      slopes = vec2(-3e38, 3e38);
    }
    last = node;
  }
  if (last.x > start.x) emit(vec2(last.x, start.y + 0.5 * (slopes.x + slopes.y) * (last.x - start.x)));
  texels[list] = uvec2(first, count);
  atomicAdd(nodesUsed, count);
}
