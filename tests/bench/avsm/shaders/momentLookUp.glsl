// Moments of absorbance (Münstermann et al. 2018): of all distributions that have these moments, the canonical one with a mass at the depth
// bounds what lies before it from both sides (Hamburger's problem); the answer is a quarter of the way from the lower to the upper bound. Bias
// towards fixed moments and that quarter are as the paper gives them for 32-bit floats.
layout(binding = 0) uniform sampler2DArray moments;

const int kHalf = MOMENTS / 2;
const float kOverestimation = 0.25;
#if MOMENTS == 4
const float kBias = 5e-7;
const float kBiased[5] = float[5](1.0, 0.0, 0.375, 0.0, 0.375);
#else
const float kBias = 5e-6;
const float kBiased[7] = float[7](1.0, 0.0, 0.48, 0.0, 0.451, 0.0, 0.45);
#endif

// The Hankel matrix of the moments as lower * diagonal * transpose of lower.
struct Factors {
  float lower[(kHalf + 1) * (kHalf + 1)];
  float inverseDiagonal[kHalf + 1];
};

Factors factorise(float moment[MOMENTS + 1]) {
  Factors f;
  float diagonal[kHalf + 1];
  for (int j = 0; j <= kHalf; ++j) {
    for (int i = j; i <= kHalf; ++i) {
      float value = moment[i + j];
      for (int k = 0; k < j; ++k) value -= f.lower[i * (kHalf + 1) + k] * f.lower[j * (kHalf + 1) + k] * diagonal[k];
      if (i == j) {
        diagonal[j] = max(value, 1e-12); // guards against rounding, the bias keeps it positive
        f.inverseDiagonal[j] = 1.0 / diagonal[j];
        f.lower[i * (kHalf + 1) + j] = 1.0;
      } else {
        f.lower[i * (kHalf + 1) + j] = value * f.inverseDiagonal[j];
      }
    }
  }
  return f;
}

// The inverse of lower, times the powers of z.
void solveLower(Factors f, float z, out float u[kHalf + 1]) {
  float power = 1.0;
  for (int i = 0; i <= kHalf; ++i) {
    u[i] = power;
    for (int k = 0; k < i; ++k) u[i] -= f.lower[i * (kHalf + 1) + k] * u[k];
    power *= z;
  }
}

// The mass that a canonical distribution has at one of its places.
float massAt(Factors f, float z) {
  float u[kHalf + 1], sum = 0.0;
  solveLower(f, z, u);
  for (int i = 0; i <= kHalf; ++i) sum += u[i] * u[i] * f.inverseDiagonal[i];
  return 1.0 / sum;
}

// Where c.x + c.y x + c.z x^2 is 0, one root far away if c.z is next to nothing.
vec2 quadraticRoots(vec3 c) {
  float root = sqrt(max(c.y * c.y - 4.0 * c.x * c.z, 0.0)), q = -0.5 * (c.y + (c.y < 0.0 ? -root : root));
  return vec2(abs(q) > 1e-20 * abs(c.z) ? q / (abs(c.z) > 1e-20 ? c.z : 1e-20) : 0.0, abs(q) > 1e-20 ? c.x / q : 0.0);
}

#if MOMENTS == 6
const float kFar = 1e5; // a root there has no mass

// The same of a cubic with three real roots: the one farthest from 0 in closed form, then those of what is left without it.
vec3 cubicRoots(vec4 c) {
  if (abs(c.w) < 1e-5 * max(abs(c.x), max(abs(c.y), abs(c.z)))) return vec3(kFar, quadraticRoots(c.xyz));
  vec3 b = c.xyz / c.w;
  float shift = b.z / 3.0, p = max(shift * shift - b.y / 3.0, 0.0), q = shift * shift * shift - 0.5 * shift * b.y + 0.5 * b.x;
  float angle = acos(clamp(-q / max(p * sqrt(p), 1e-30), -1.0, 1.0)) / 3.0, size = 2.0 * sqrt(p);
  float high = size * cos(angle) - shift, low = size * cos(angle + 2.0943951) - shift;
  float far = abs(high) > abs(low) ? high : low;
  float constant = -b.x / far, linear = (constant - b.y) / far;
  return vec3(far, quadraticRoots(vec3(constant, linear, 1.0)));
}
#endif

// The share of the absorbance up to z, by moments of one whole.
float shareUpTo(float z, float moment[MOMENTS + 1]) {
  Factors f = factorise(moment);
  float u[kHalf + 1], c[kHalf + 1], sum = 0.0;
  solveLower(f, z, u);
  for (int i = 0; i <= kHalf; ++i) sum += u[i] * u[i] * f.inverseDiagonal[i];
  for (int i = kHalf; i >= 0; --i) {
    c[i] = u[i] * f.inverseDiagonal[i];
    for (int k = i + 1; k <= kHalf; ++k) c[i] -= f.lower[k * (kHalf + 1) + i] * c[k];
  }
  float share = kOverestimation / sum;
#if MOMENTS == 4
  vec2 roots = quadraticRoots(vec3(c[0], c[1], c[2]));
#else
  vec3 roots = cubicRoots(vec4(c[0], c[1], c[2], c[3]));
#endif
  for (int i = 0; i < kHalf; ++i)
    if (roots[i] < z) share += massAt(f, max(roots[i], -100.0)); // from far away nothing comes, and no overflow
  return clamp(share, 0.0, 1.0);
}

float transmittanceOf(vec4 first, vec4 second, float depth) {
  if (first.x < 1e-5) return 1.0;
  float moment[MOMENTS + 1];
#if MOMENTS == 4
  float sums[5] = float[5](first.x, first.y, first.z, first.w, second.x);
#else
  float sums[7] = float[7](first.x, first.y, first.z, first.w, second.x, second.y, second.z);
#endif
  for (int i = 0; i <= MOMENTS; ++i) moment[i] = mix(sums[i] / first.x, kBiased[i], kBias);
  return exp(-first.x * shareUpTo(2.0 * depth - 1.0, moment));
}

float transmittanceAt(ivec2 texel, float depth) {
  return transmittanceOf(texelFetch(moments, ivec3(texel, 0), 0), texelFetch(moments, ivec3(texel, 1), 0), depth);
}

// By the texture unit: of moments.
float transmittanceIn(vec2 place, float depth) {
  return transmittanceOf(texture(moments, vec3(place, 0.0)), texture(moments, vec3(place, 1.0)), depth);
}
