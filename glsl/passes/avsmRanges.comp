// AVSM ranges: least and most density that is read within bricks of a volume's grid, for what walks through it to step over those that are empty or
// even (avsmVolumes.comp). FINEST 1: of bricks of 4 x 4 x 4 texels, each with the texels around it that trilinear reading takes in; 0: of 2 x 2 x 2
// nodes of the level before. Reads the density (R8, R16, R16F, R32F) or the ranges. Writes a level of ranges (RG32F), whose sides are powers of 2.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0) uniform sampler3D source;
layout(rg32f, binding = 0) writeonly uniform image3D levelOut;
uniform int sourceLevel;

const int kBrick = 4;

#include "lib/avsmDensity.glsl"

void main() {
  ivec3 node = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(node, imageSize(levelOut)))) return;
#if FINEST
  ivec3 size = textureSize(source, 0), low = max(kBrick * node - 1, ivec3(0)), high = min(kBrick * node + kBrick, size - 1);
#else
  ivec3 size = textureSize(source, sourceLevel), low = min(2 * node, size - 1), high = min(2 * node + 1, size - 1);
#endif
  vec2 range = vec2(1e37, 0.0); // of what lies beyond the grid
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
#if FINEST
        vec2 own = vec2(cleanedDensity(texelFetch(source, ivec3(x, y, z), 0).r));
#else
        vec2 own = texelFetch(source, ivec3(x, y, z), sourceLevel).rg;
#endif
        range = vec2(min(range.x, own.x), max(range.y, own.y));
      }
  imageStore(levelOut, node, vec4(range, 0.0, 0.0));
}
