// Fourier opacity map (Jansen and Bavoil 2010, equation 10): the integral of the series up to a depth.
layout(binding = 0) uniform sampler2DArray coefficients;

const float kTwoPi = 6.28318531;

vec2 turned(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

// The share of one term k > 0: pair (a, b) and wave (cos, sin) of it.
float termOf(vec2 pair, vec2 wave, int k) { return (pair.x * wave.y + pair.y * (1.0 - wave.x)) / (kTwoPi * float(k)); }

#define OPTICAL_DEPTH(FETCH)                                    \
  vec2 turn = vec2(cos(kTwoPi * depth), sin(kTwoPi * depth));   \
  vec2 wave = turn;                                             \
  vec4 pairs = FETCH(0);                                        \
  float sum = 0.5 * pairs.x * depth + termOf(pairs.zw, wave, 1); \
  for (int i = 1; i < TERMS / 2; ++i) {                         \
    pairs = FETCH(i);                                           \
    wave = turned(wave, turn);                                  \
    sum += termOf(pairs.xy, wave, 2 * i);                       \
    wave = turned(wave, turn);                                  \
    sum += termOf(pairs.zw, wave, 2 * i + 1);                   \
  }

#define TEXEL(i) texelFetch(coefficients, ivec3(texel, i), 0)
#define FILTERED(i) texture(coefficients, vec3(place, float(i)))

float transmittanceAt(ivec2 texel, float depth) {
  OPTICAL_DEPTH(TEXEL)
  return clamp(exp(-sum), 0.0, 1.0);
}

// By the texture unit: of coefficients.
float transmittanceIn(vec2 place, float depth) {
  OPTICAL_DEPTH(FILTERED)
  return clamp(exp(-sum), 0.0, 1.0);
}
