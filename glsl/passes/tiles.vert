// Tiles: one square of 16 x 16 pixels for each that has changed. Reads changedTiles. Draws 6 vertices an instance.
#include "shared.glsl"

uniform sampler2D changedTiles;

void main() {
  const int kTile = 16;
  int across = (counts.z + kTile - 1) / kTile;
  ivec2 tile = ivec2(gl_InstanceID % across, gl_InstanceID / across);
  bool changed = texelFetch(changedTiles, ivec2(gl_InstanceID % 256, gl_InstanceID / 256), 0).r > 0.0;
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(kTile * (tile + ivec2(right ? 1 : 0, top ? 1 : 0))) / vec2(counts.zw);
  gl_Position = changed ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
