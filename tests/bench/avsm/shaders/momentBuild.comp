// Moments of absorbance over depth (Münstermann et al. 2018): the whole absorbance and its first MOMENTS power moments, depth taken from -1 to
// 1. Of segments of even density by four Gauss nodes, exact for powers up to 7. Reads the lists. Writes moments (RGBA32F, whole absorbance
// first).
#include "lib/avsm.glsl"
#include "segments.glsl"

layout(rgba32f, binding = 0) uniform writeonly image2DArray moments;

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  const vec2 gauss[2] = vec2[2](vec2(0.339981044, 0.326072577), vec2(0.861136312, 0.173927423)); // place and weight
  float sums[8];
  for (int k = 0; k < 8; ++k) sums[k] = 0.0;
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) {
    vec3 segment = segmentAt(at);
    float own = absorbance(segment.z), middle = segment.x + segment.y - 1.0, halfLength = segment.y - segment.x;
    for (int i = 0; i < 4; ++i) {
      vec2 node = gauss[i / 2];
      float z = middle + halfLength * (i % 2 == 0 ? node.x : -node.x), power = own * node.y;
      for (int k = 0; k <= MOMENTS; ++k) {
        sums[k] += power;
        power *= z;
      }
    }
  }
  imageStore(moments, ivec3(texel.xy, 0), vec4(sums[0], sums[1], sums[2], sums[3]));
  imageStore(moments, ivec3(texel.xy, 1), vec4(sums[4], sums[5], sums[6], sums[7]));
}
