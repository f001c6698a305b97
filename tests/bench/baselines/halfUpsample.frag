// Joint bilateral upsampling (Kopf 2007): a pixel takes its four half-resolution neighbours by bilinear weight times the
// agreement of their distances with its own. Reads half-resolution inscatter and distance, and the scene depth.
// Writes inscatter and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "common/agreement.glsl"
#include "common/final.glsl"

uniform sampler2D halfInscatter;
uniform sampler2D halfEnd;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  vec2 p = 0.5 * gl_FragCoord.xy - 0.5;
  ivec2 low = ivec2(floor(p)), last = textureSize(halfEnd, 0) - 1;
  vec2 f = p - vec2(low);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1), at = clamp(low + corner, ivec2(0), last);
    vec2 share = mix(1.0 - f, f, vec2(corner));
    // The floor lets the best of four bad neighbours win where none agrees.
    float agreement = max(agreementOf(comparableEnd(texelFetch(halfEnd, at, 0).r), comparableEnd(end)), 1e-12);
    sum += share.x * share.y * agreement * vec4(texelFetch(halfInscatter, at, 0).rgb, 1.0);
  }
  writeFinal(sum.rgb / sum.w, end);
}
