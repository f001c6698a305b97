// A medium part of which thins out with height (Medium::layers): layer j has density exp(-e), e = max(dot(layerUp[j].xyz, x) + layerUp[j].w,
// ground), an exponent that is linear along a ray, cut at the ground. HEIGHT 1: all of the medium follows its only layer; 2: some of it
// does; both but for suns that lose light before the ray; 3: any medium, any light.

#if HEIGHT < 3
#define Layers float // a number for each layer
#define LAYERS(first, second) (first)
Layers moreThan(Layers a, Layers b, Layers yes, Layers no) { return a > b ? yes : no; }
float sumOf(Layers x) { return x; }
float leastOf(Layers x) { return x; }
Spectrum layersExtinction(Layers density) { return density * SPECTRUM(layerExtinction[0]); }
#else
#define Layers vec2
#define LAYERS(first, second) vec2(first, second)
Layers moreThan(Layers a, Layers b, Layers yes, Layers no) { return mix(no, yes, greaterThan(a, b)); }
float sumOf(Layers x) { return x.x + x.y; }
float leastOf(Layers x) { return min(x.x, x.y); }
Spectrum layersExtinction(Layers density) { return density.x * SPECTRUM(layerExtinction[0]) + density.y * SPECTRUM(layerExtinction[1]); }
#endif

Spectrum extinctionOf(Layers density) { return SPECTRUM(extinction) + layersExtinction(density); }

// Exponents along a ray: at s they are begin + s slope.
struct Heights {
  Layers begin, slope;
  Layers beginDensity;
};

Layers exponentsAt(vec3 x) { return LAYERS(dot(layerUp[0].xyz, x) + layerUp[0].w, dot(layerUp[1].xyz, x) + layerUp[1].w); }
Layers exponentSlopes(vec3 direction) { return LAYERS(dot(layerUp[0].xyz, direction), dot(layerUp[1].xyz, direction)); }
Layers groundExponents() { return LAYERS(layerExtinction[0].w, layerExtinction[1].w); }

Layers densities(Layers exponents) { return exp(-max(exponents, groundExponents())); }

Heights heightsAlong(Ray ray) {
  Layers begin = exponentsAt(ray.origin);
  return Heights(begin, exponentSlopes(ray.direction), densities(begin));
}

// (1 - exp(-x)) / x for x >= 0, where exp(-x) is known.
Layers relativeFall(Layers x, Layers passed) {
  return moreThan(x, Layers(0.1), (1.0 - passed) / max(x, 0.1), 1.0 + x * (-1.0 / 2.0 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0)))));
}

// The mean density on the way between two exponents, as a share of the greater one: of what lies below the ground that of the ground; above,
// it falls from the lower end on. What lies below is never a difference of the two: of a way to the sky it is less than a float's last digit.
Layers meanShares(Layers a, Layers b) {
  Layers ground = groundExponents(), above = abs(max(a, ground) - max(b, ground)), below = max(ground - min(a, b), 0.0);
  Layers mean = (below + above * relativeFall(above, exp(-above))) / max(below + above, 1e-37);
  return moreThan(above, Layers(0.0), mean, Layers(1.0));
}

Layers meanDensities(Layers a, Layers b) { return densities(min(a, b)) * meanShares(a, b); }

// The same where the densities there are known.
Layers meanDensities(Layers a, Layers b, Layers densityA, Layers densityB) { return max(densityA, densityB) * meanShares(a, b); }

// On the way from the ray's origin to where the exponents and densities are these.
Layers meanDensities(Heights heights, Layers there, Layers density) { return meanDensities(heights.begin, there, heights.beginDensity, density); }

// Optical depth from the ray's origin to s.
Spectrum depthTo(Heights heights, float s) {
  Layers there = heights.begin + s * heights.slope;
  return s * extinctionOf(meanDensities(heights, there, densities(there)));
}
