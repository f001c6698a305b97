// Changed strips: the whole target or, for temporal reuse, where slices have changed, ALONG which axis lib/changedStrips.glsl says. Reads
// changedSlices. Vertices: lib/partly.glsl.
#include "shared.glsl"
#include "lib/partly.glsl"
#include "lib/changedStrips.glsl"

flat out int isPart; // 1: only what has changed is drawn

void main() {
  isPart = gl_VertexID < 3 ? 0 : 1;
  gl_Position = isPart == 0 ? wholeTarget(gl_VertexID) : stripVertex(gl_VertexID - 3);
}
