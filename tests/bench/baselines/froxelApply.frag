// Froxel look-up: the integral up to a pixel's distance, trilinear. Layer k of the volume holds the light up to boundary
// k + 1; before the first it grows from 0; layer n holds all of a ray that ends behind the n slices.
// Reads the scene depth and the volume. Writes inscatter and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "common/froxel.glsl"
#include "common/final.glsl"

uniform sampler3D volume;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  float k = boundaryOf(min(end, visibleEnd));
  float layer = end > 1.001 * farEnd ? float(slices) + 0.5 : max(k, 1.0) - 0.5;
  vec3 at = vec3(gl_FragCoord.xy / vec2(frameSize), layer / float(textureSize(volume, 0).z));
  writeFinal(textureLod(volume, at, 0.0).rgb * min(k, 1.0), end);
}
