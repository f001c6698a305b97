// Gives the segments of a scene to tyndallCapture(), one an invocation. Reads segments (texel as y * size + x; entry, exit and transmittance as
// bits of floats). Writes the lists.
#include "public/avsmCapture.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 3) readonly buffer Drawn { uvec4 drawn[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(drawn.length())) return;
  vec3 values = uintBitsToFloat(drawn[i].yzw);
  tyndallCapture(ivec3(drawn[i].x % uint(tyndallSize.x), drawn[i].x / uint(tyndallSize.x), 0), values.x, values.y, values.z);
}
