// A medium part of which thins out with height (Medium::layers). Layer j has density exp(-e), e = max(dot(layerUp[j].xyz, x) + layerUp[j].w,
// ground): an exponent that is linear along a ray, cut at the ground. Layers come in pairs, as x and y of a vector.

// Exponents along a ray: at s they are begin + s slope.
struct Heights {
  vec2 begin, slope;
};

vec2 exponentsAt(vec3 x) { return vec2(dot(layerUp[0].xyz, x) + layerUp[0].w, dot(layerUp[1].xyz, x) + layerUp[1].w); }
vec2 exponentSlopes(vec3 direction) { return vec2(dot(layerUp[0].xyz, direction), dot(layerUp[1].xyz, direction)); }
vec2 groundExponents() { return vec2(layerExtinction[0].w, layerExtinction[1].w); }

Heights heightsAlong(Ray ray) { return Heights(exponentsAt(ray.origin), exponentSlopes(ray.direction)); }

vec2 densities(vec2 exponents) { return exp(-max(exponents, groundExponents())); }

// The mean of a layer's density on the way between two exponents: of what lies below the ground it is that of the ground, above it falls
// from the lower end on.
float meanDensity(float a, float b, float ground) {
  float low = max(min(a, b), ground), above = max(max(a, b), ground) - low, width = abs(b - a);
  float share = above < width ? above / width : 1.0; // of the way that lies above the ground
  return exp(-low) * (1.0 - share + share * relativeExpm1(above));
}
vec2 meanDensities(vec2 a, vec2 b) {
  return vec2(meanDensity(a.x, b.x, layerExtinction[0].w), meanDensity(a.y, b.y, layerExtinction[1].w));
}

Spectrum layersExtinction(vec2 density) { return density.x * SPECTRUM(layerExtinction[0]) + density.y * SPECTRUM(layerExtinction[1]); }
Spectrum extinctionOf(vec2 density) { return SPECTRUM(extinction) + layersExtinction(density); }

// Optical depth from the ray's origin to s.
Spectrum depthTo(Heights heights, float s) {
  return s * extinctionOf(meanDensities(heights.begin, heights.begin + s * heights.slope));
}
