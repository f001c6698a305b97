// Fourier opacity map (Jansen and Bavoil 2010, equations 8 and 9): coefficients of the attenuation as a Fourier series over the map's range of
// depths, TERMS of cosines and of sines; of segments of even density in closed form. Reads the lists. Writes coefficients (RGBA32F, two terms
// a layer).
#include "lib/avsm.glsl"
#include "segments.glsl"

layout(rgba32f, binding = 0) uniform writeonly image2DArray coefficients;

const float kTwoPi = 6.28318531;

vec2 turned(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  vec2 sums[TERMS];
  for (int k = 0; k < TERMS; ++k) sums[k] = vec2(0.0);
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) {
    vec3 segment = segmentAt(at);
    float own = 2.0 * absorbance(segment.z), middle = kTwoPi * 0.5 * (segment.x + segment.y), halfLength = kTwoPi * 0.5 * (segment.y - segment.x);
    // The mean of a wave over the segment is the wave at its middle times sin(x) / x.
    vec2 turn = vec2(cos(middle), sin(middle)), wave = vec2(1.0, 0.0), halfTurn = vec2(cos(halfLength), sin(halfLength)), halfWave = vec2(1.0, 0.0);
    sums[0].x += own;
    for (int k = 1; k < TERMS; ++k) {
      wave = turned(wave, turn);
      halfWave = turned(halfWave, halfTurn);
      float x = halfLength * float(k);
      sums[k] += own * wave * (x > 1e-2 ? halfWave.y / x : 1.0 - x * x / 6.0);
    }
  }
  for (int i = 0; i < TERMS / 2; ++i) imageStore(coefficients, ivec3(texel.xy, i), vec4(sums[2 * i], sums[2 * i + 1]));
}
