// March: all slices or, for temporal reuse, where they have changed; from vertex 9 on the same of the image. Reads changedSlices,
// changedTiles. Vertices: lib/partly.glsl.
#include "shared.glsl"
#include "lib/partly.glsl"
#include "lib/changedStrips.glsl"
#include "lib/changedTiles.glsl"

flat out int isImage; // 1: pixels, not samples
flat out int isPart;  // 1: only what has changed is drawn

void main() {
  isImage = gl_VertexID < 9 ? 0 : 1;
  int vertex = gl_VertexID - 9 * isImage;
  isPart = vertex < 3 ? 0 : 1;
  gl_Position = isPart == 0 ? wholeTarget(vertex) : isImage == 0 ? stripVertex(vertex - 3) : tileVertex(vertex - 3);
}
