// Tiles: a square of 16 x 16 pixels for each that has changed; four around a corner as one, since the pixels along the diagonal between
// a square's two triangles are shaded twice. Needs lib/partly.glsl.

uniform sampler2D changedTiles;

const int kTile = 16;

bool isChanged(ivec2 tile, ivec2 tiles) {
  int index = tile.y * tiles.x + tile.x;
  return tile.x < tiles.x && tile.y < tiles.y && texelFetch(changedTiles, ivec2(index % 256, index / 256), 0).r > 0.0;
}

// One of an instance's six vertices.
vec4 tileVertex(int vertex) {
  ivec2 tiles = (frameSize + kTile - 1) / kTile, tile = ivec2(gl_InstanceID % tiles.x, gl_InstanceID / tiles.x), first = tile & ~1;
  bool four = isChanged(first, tiles) && isChanged(first + ivec2(1, 0), tiles) && isChanged(first + ivec2(0, 1), tiles) &&
              isChanged(first + 1, tiles);
  bool drawn = four ? tile == first : isChanged(tile, tiles);
  vec2 corner = vec2(kTile * (tile + (four ? 2 : 1) * ivec2(cornerOf(vertex)))) / vec2(frameSize);
  return drawn ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
