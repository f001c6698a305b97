// The sum of all faces into the picture. Reads the sum and the scene depth. Writes inscatter and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "common/final.glsl"

uniform sampler2D faces;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  writeFinal(max(texelFetch(faces, ivec2(gl_FragCoord.xy), 0).rgb, vec3(0.0)), end);
}
