// The phase function of all constituents together: their mean by scattering. Isotropic, Rayleigh, Henyey-Greenstein and Cornette-Shanks share one form,
//   p = norm (1 + c cos^2) (a + b (1 - cos))^(-3/2),  a = (1 - |g|)^2, b = 2 |g|   (1 + cos for g < 0),
// in which nothing cancels near the peak: 1 + g^2 - 2 g cos = (1 - |g|)^2 + 2 |g| (1 - cos) for g >= 0.

#if MONOCHROME
#define Spectrum float
#define SPECTRUM(v) (v).x
#else
#define Spectrum vec3
#define SPECTRUM(v) (v).rgb
#endif

#include "lib/exponential.glsl"

#if HEIGHT
#include "lib/height.glsl"
Spectrum opticalDepthTo(Ray ray, float s) { return depthTo(heightsAlong(ray), s); }
#else
Spectrum opticalDepthTo(Ray ray, float s) { return SPECTRUM(extinction) * s; }
#endif

// Of the picture behind: T(s) of DESIGN 1.
vec3 transmittanceTo(Ray ray, float s) { return dimsBackground != 0 ? vec3(exp(-opticalDepthTo(ray, s))) : vec3(1.0); }

#if FOG
// Of what curves before the eye scatter, but for its norm.
float fogPhase(float oneMinusCos, float onePlusCos) {
  float cosine = 0.5 * (onePlusCos - oneMinusCos), r = inversesqrt(fogShape.x + fogShape.y * (fogShape.w > 0.0 ? oneMinusCos : onePlusCos));
  return (1.0 + fogShape.z * cosine * cosine) * (r * r * r);
}

bool scattersInFog = false; // while light is added that it scatters
#endif

// Sum over constituents of sigma_k p_k over the sum of sigma_k, 1/sr. Takes 1 - cos and 1 + cos of the scattering angle.
Spectrum phaseTowardsEye(float oneMinusCos, float onePlusCos) {
#if FOG && LIGHT_KIND != 0
  if (scattersInFog) return fogScattering * fogPhase(oneMinusCos, onePlusCos);
#endif
  float cosSquared = 0.25 * (onePlusCos - oneMinusCos) * (onePlusCos - oneMinusCos);
  Spectrum sum = Spectrum(0.0);
  for (int k = 0; k < constituentCount; ++k) {
    vec4 shape = phaseShape[k];
    float d = shape.x + shape.y * (shape.w > 0.0 ? oneMinusCos : onePlusCos);
    float r = inversesqrt(d);
    sum += SPECTRUM(phaseWeight[k]) * ((1.0 + shape.z * cosSquared) * (r * r * r));
  }
  return sum;
}

#if HEIGHT
// The same in parts: of the constituents that are the same everywhere, and of those that follow each layer, where density is 1.
struct Phases {
  Spectrum even, first;
#if HEIGHT > 2
  Spectrum second;
#endif
};

Phases phasesTowardsEye(float oneMinusCos, float onePlusCos) {
  float cosSquared = 0.25 * (onePlusCos - oneMinusCos) * (onePlusCos - oneMinusCos);
  Phases phases;
  phases.even = phases.first = Spectrum(0.0);
#if HEIGHT > 2
  phases.second = Spectrum(0.0);
#endif
#if FOG && LIGHT_KIND != 0
  if (scattersInFog) {
    phases.even = fogScattering * fogPhase(oneMinusCos, onePlusCos);
    return phases;
  }
#endif
  for (int k = 0; k < constituentCount; ++k) {
    vec4 shape = phaseShape[k];
    float d = shape.x + shape.y * (shape.w > 0.0 ? oneMinusCos : onePlusCos);
    float r = inversesqrt(d), layer = phaseWeight[k].w;
    Spectrum phase = SPECTRUM(phaseWeight[k]) * ((1.0 + shape.z * cosSquared) * (r * r * r));
    phases.even += layer == 0.0 ? phase : Spectrum(0.0);
    phases.first += layer == 1.0 ? phase : Spectrum(0.0);
#if HEIGHT > 2
    phases.second += layer == 2.0 ? phase : Spectrum(0.0);
#endif
  }
  // Nothing is scattered in a channel in which a layer takes nothing, however dense it is.
  phases.first *= Spectrum(1.0) - step(SPECTRUM(layerExtinction[0]), Spectrum(0.0));
#if HEIGHT > 2
  phases.second *= Spectrum(1.0) - step(SPECTRUM(layerExtinction[1]), Spectrum(0.0));
#endif
  return phases;
}

Spectrum layersPhase(Phases phases, Layers density) {
#if HEIGHT > 2
  return density.x * phases.first + density.y * phases.second;
#else
  return density * phases.first;
#endif
}
Spectrum phaseOf(Phases phases, Layers density) { return phases.even + layersPhase(phases, density); }

// As parts of their sum.
Phases sharesOf(Phases phases) {
  Spectrum all = 1.0 / max(phaseOf(phases, Layers(1.0)), Spectrum(1e-30));
  phases.even *= all;
  phases.first *= all;
#if HEIGHT > 2
  phases.second *= all;
#endif
  return phases;
}
#endif

// The same of a directional light along a camera ray. theta lies between the light's travel and the direction to the eye:
// cos = -dot(l, v), |l + v|^2 / 2 = 1 - cos.
Spectrum phaseAlong(Ray ray) {
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  return phaseTowardsEye(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
}
