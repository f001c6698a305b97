// Keep depth: the scene depth, for the next frame to be compared with. Writes R32F.
#include "lib/depth.glsl"

layout(location = 0) out vec4 outDepth;

void main() { outDepth = vec4(depthAt(ivec2(gl_FragCoord.xy), 0)); }
