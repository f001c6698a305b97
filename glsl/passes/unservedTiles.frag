// Unserved tiles: of 16 x 16 pixels, those that hold one that unwarp left. Reads unserved (image size): 1 for such a pixel.
// Writes tiles, one after the other in lines of 256, R32F: 1, or 0.
#include "shared.glsl"

const int kTile = 16;

uniform sampler2D unserved;
layout(location = 0) out vec4 outTile;

void main() {
  int across = (frameSize.x + kTile - 1) / kTile, tile = int(gl_FragCoord.x) + 256 * int(gl_FragCoord.y);
  ivec2 first = kTile * ivec2(tile % across, tile / across), last = min(first + kTile, frameSize) - 1;
  float any = 0.0;
  for (int y = first.y; y <= last.y && any == 0.0; ++y)
    for (int x = first.x; x <= last.x; ++x) any = max(any, texelFetch(unserved, ivec2(x, y), 0).r);
  outTile = vec4(any);
}
