// Tiles: the whole image or, for temporal reuse, the tiles that have changed. Reads changedTiles. Vertices: lib/partly.glsl.
#include "shared.glsl"
#include "lib/partly.glsl"
#include "lib/changedTiles.glsl"

void main() { gl_Position = gl_VertexID < 3 ? wholeTarget(gl_VertexID) : tileVertex(gl_VertexID - 3); }
