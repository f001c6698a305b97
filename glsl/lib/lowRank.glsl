// Low rank: the airlight of a lit span as a sum of few products, a factor of the camera ray times a difference of prefix
// sums over the light rays that cross it (Chen 2011, 3.2 and 3.4; effect/src/optics/LowRank.cpp). Takes the place of
// addAirlight() in what is included after it.

uniform sampler2D lowRankRays;   // grid x terms: the ray's factors
uniform sampler2D lowRankLights; // sets x (2 terms grid): prefix sums, then the light's factors

const int kLowRankGrid = 64;

// Of the camera ray that is integrated.
struct LowRankRay {
  bool valid;      // else it is too near to the direction of a light for the grid
  int set;
  float scale;     // directional: x = s scale; lamp: half a turn less beta
  Spectrum factor;
  int cell;        // of the grid of camera rays, and the place in it
  float place;
} lowRank;

void startLowRank(Ray ray, int slice) {
  Airlight light = airlightOf(ray);
#if LIGHT_KIND == 0
  lowRank.scale = length(cross(lightDirection, ray.direction));
  float place = (log(max(lowRank.scale, 1e-30)) - lowRankRayBegin) * lowRankRayScale;
  lowRank.valid = place >= -0.01;
  lowRank.factor = light.phase / max(lowRank.scale, 1e-30);
#else
  float beta = atan(sqrt(light.height2), light.foot), place = (beta - lowRankRayBegin) * lowRankRayScale;
  lowRank.scale = 1.5707963267948966 - beta;
  lowRank.valid = true;
  lowRank.factor = Spectrum(inversesqrt(light.height2));
#endif
  lowRank.set = lowRankPerSlice != 0 ? slice : 0;
  lowRank.cell = clamp(int(place), 0, kLowRankGrid - 2);
  lowRank.place = clamp(place - float(lowRank.cell), 0.0, 1.0);
}

// The ray's factor of a term: fetched where it is needed, for eight of them would fill the registers.
Spectrum rayTerm(int term) {
  vec4 low = texelFetch(lowRankRays, ivec2(lowRank.cell, term), 0), high = texelFetch(lowRankRays, ivec2(lowRank.cell + 1, term), 0);
  return SPECTRUM(mix(low, high, lowRank.place));
}

#if LIGHT_KIND == 0
// The place of a light ray, at a distance from the line through the eye along the light, in the grid: the cell, the place in it from 0 to 1, the
// cell's length.
vec3 placeOfLight(float x) {
  float last = float(kLowRankGrid - 1);
  x = clamp(x, 0.0, lowRankLightExtent);
  float cell = clamp(floor(last * pow(x / lowRankLightExtent, 1.0 / 3.0)), 0.0, last - 1.0);
  float unit = lowRankLightExtent / (last * last * last), begin = cell * cell * cell * unit;
  float len = (3.0 * cell * (cell + 1.0) + 1.0) * unit;
  return vec3(cell, clamp((x - begin) / len, 0.0, 1.0), len);
}

// Of the one that crosses the ray at s.
vec3 lightPlace(Airlight light, float s) { return placeOfLight(s * lowRank.scale); }
#else
// The same of a light ray at an angle to the line from the lamp to the eye.
vec3 placeOfLight(float gamma) {
  float last = float(kLowRankGrid - 1), at = clamp((gamma - lowRankLightBegin) / lowRankLightExtent * last, 0.0, last);
  float cell = min(floor(at), last - 1.0);
  return vec3(cell, at - cell, lowRankLightExtent / last);
}

vec3 lightPlace(Airlight light, float s) {
  return placeOfLight(atan((s - light.foot) * inversesqrt(light.height2)) + lowRank.scale);
}
#endif

// A term's prefix sum up to a place: the cubic through the sums and slopes at the cell's ends.
Spectrum prefixSum(int term, vec3 place) {
  ivec2 at = ivec2(lowRank.set, 2 * term * kLowRankGrid + int(place.x)), slopes = at + ivec2(0, kLowRankGrid);
  Spectrum c0 = SPECTRUM(texelFetch(lowRankLights, at, 0)), c1 = SPECTRUM(texelFetch(lowRankLights, at + ivec2(0, 1), 0));
  Spectrum g0 = place.z * SPECTRUM(texelFetch(lowRankLights, slopes, 0)), g1 = place.z * SPECTRUM(texelFetch(lowRankLights, slopes + ivec2(0, 1), 0));
  float q = place.y;
  return c0 + q * (g0 + q * (3.0 * (c1 - c0) - 2.0 * g0 - g1 + q * (2.0 * (c0 - c1) + g0 + g1)));
}

void addLowRank(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  if (!lowRank.valid) addAirlight(light, s0, s1, visibility, sum);
  if (!lowRank.valid || !(s1 > s0)) return;
  vec3 from = lightPlace(light, s0), to = lightPlace(light, s1);
  Spectrum own = Spectrum(0.0);
  for (int i = 0; i < lowRankTerms; ++i) own += rayTerm(i) * (prefixSum(i, to) - prefixSum(i, from));
  sum += visibility * Light(lowRank.factor * own);
}

// What the products come to, kept from none of the light to all of it: they are an approximation, worst where the medium is thick or
// the phase function peaked.
vec3 withinUnshadowed(vec3 own, Ray ray, float end) {
  Airlight light = airlightOf(ray);
  float s0 = 0.0, s1 = end;
  litRange(light, s0, s1);
  Light all = Light(0.0);
  if (s1 > s0) addAirlight(light, s0, s1, Visibility(1.0), all);
  return clamp(own, vec3(0.0), vec3(all));
}

#define addAirlight addLowRank
