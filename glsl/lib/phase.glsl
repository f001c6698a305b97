// Phase functions of all constituents at once. Isotropic, Rayleigh, Henyey-Greenstein and Cornette-Shanks share one form,
//   p = norm (1 + c cos^2) (a + b (1 - cos))^(-3/2),  a = (1 - |g|)^2, b = 2 |g|   (1 + cos for g < 0),
// in which nothing cancels near the peak: 1 + g^2 - 2 g cos = (1 - |g|)^2 + 2 |g| (1 - cos) for g >= 0.

#if MONOCHROME
#define Spectrum float
#define SPECTRUM(v) (v).x
#else
#define Spectrum vec3
#define SPECTRUM(v) (v).rgb
#endif

// T(s) of DESIGN 1.
vec3 transmittanceTo(float s) { return vec3(exp(-SPECTRUM(extinction) * s)); }

// Sum over constituents of sigma_k p_k, 1/(world unit sr). Takes 1 - cos and 1 + cos of the scattering angle.
Spectrum scatteringTowardsEye(float oneMinusCos, float onePlusCos) {
  float cosSquared = 0.25 * (onePlusCos - oneMinusCos) * (onePlusCos - oneMinusCos);
  Spectrum sum = Spectrum(0.0);
  for (int k = 0; k < counts.x; ++k) {
    vec4 shape = phaseShape[k];
    float d = shape.x + shape.y * (shape.w > 0.0 ? oneMinusCos : onePlusCos);
    sum += SPECTRUM(scattering[k]) * ((1.0 + shape.z * cosSquared) * inversesqrt(d) / d);
  }
  return sum;
}
