// A directional light in a medium part of which thins out with height. Included by airlight.glsl. NO_BOUNDARY: none dims the light before
// the ray; else HEIGHT 3 looks for one.
#if HEIGHT == 3 && !defined(NO_BOUNDARY)
#define LOSES_LIGHT 1
#else
#define LOSES_LIGHT 0
#endif

struct Airlight {
  Phases phases; // constant along the ray; PHASE_APART: as parts of their sum
  Heights heights;
  float path;     // the light's way through the medium to the point s is max(0, path + s pathSlope)
  float pathSlope;
};

Airlight airlightOf(Ray ray) {
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  Phases phases = phasesTowardsEye(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
#ifdef PHASE_APART
  phases = sharesOf(phases);
#endif
  return Airlight(phases, heightsAlong(ray), dot(boundary.xyz, ray.origin) + boundary.w, dot(boundary.xyz, ray.direction));
}

void litRange(Airlight light, inout float s0, inout float s1) {}

// The light's way to the point s and on to the eye.
Way wayOf(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope;
  Layers density = densities(here);
  Spectrum eye = s * extinctionOf(meanDensities(light.heights, here, density)), whole = eye;
#if LOSES_LIGHT
  float path = light.path + s * light.pathSlope;
  Layers before = here - path * exponentSlopes(lightDirection);
  if (path > 0.0) whole += path * extinctionOf(meanDensities(here, before, density, densities(before)));
#endif
  return Way(min(eye, Spectrum(kEndless)), min(whole, Spectrum(kEndless)));
}

// What is taken of the light a unit of length, at s, at most, in each channel.
Spectrum takenAt(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope, density = densities(here);
  Spectrum taken = extinctionOf(density);
#if LOSES_LIGHT
  // The light's way ends elsewhere on the boundary: pathSlope more of the density there; and all of it is at another height.
  float path = max(light.path + s * light.pathSlope, 0.0);
  Layers fall = exponentSlopes(lightDirection), there = densities(here - path * fall);
  Layers higher = abs(light.heights.slope) * min(abs(there - density) / max(abs(fall), 1e-30), path * max(there, density));
  if (path > 0.0) taken += SPECTRUM(extinction) * abs(light.pathSlope) + layersExtinction(there * abs(light.pathSlope) + higher);
#endif
  return taken;
}

// Change of the airlight's logarithm a unit of length, at s, at most.
float rateAt(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope;
  return greatestOf(takenAt(light, s)) + sumOf(abs(light.heights.slope) * aboveGround(here));
}

// How far light comes through layers on its way to a span, at a density of 1.
Layers lightLengths(Airlight light, float s0, float s1) {
  Layers fall = abs(exponentSlopes(lightDirection)); // e-folds that light comes through, a unit of length
  return min(1.0 / max(fall, 1e-30), max(light.path + max(s0 * light.pathSlope, s1 * light.pathSlope), 0.0));
}

// A length from s on over which the airlight changes by about a twentieth in any channel, but more and more where less is left of it.
float steadyLength(Airlight light, float s0, float s1, float s) {
  Followed followed = followedAt(light.heights, s0, s1, s, lightLengths(light, s0, s1));
  Spectrum shortest = min(wayOf(light, s0).whole, wayOf(light, s1).whole);
  return steadyLength(light.heights, followed, s, wayOf(light, s).whole, shortest, takenAt(light, s));
}

// True if that is sure to be longer: what it takes to tell is little.
bool isSteady(Airlight light, float s, float len) { return len * max(rateAt(light, s), rateAt(light, s + len)) < 0.05; }

// The longest span of [s0, s1] over which a line stands for the airlight: of an optical depth and e-folds of at most `most`.
float evenLength(Airlight light, float most, float s0, float s1) { return most / max(max(rateAt(light, s0), rateAt(light, s1)), 1e-30); }

#if HEIGHT == 1

// What extinction takes is in proportion to what is scattered: the integral of density times transmittance is (T(s0) - T(s1)) / sigma.
void addAirlight(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
  Layers begin = light.heights.begin, e0 = begin + s0 * light.heights.slope, e1 = begin + s1 * light.heights.slope, d0 = densities(e0);
  // No more than floats hold: what is as dense as that is dark.
  float before = min(s0 * meanDensities(light.heights, e0, d0), 1e30), own = min(max(s1 - s0, 0.0) * meanDensities(e0, e1, d0, densities(e1)), 1e30);
  Spectrum sigma = layersExtinction(1.0);
  sum += visibility * Light(light.phases.first * exp(-sigma * before) * relativeExpm1(sigma * own) * own);
}

#else

Spectrum integrandAt(Airlight light, float s) {
  return phaseOf(light.phases, densities(light.heights.begin + s * light.heights.slope)) * exp(-wayOf(light, s).whole);
}

// How long the panel from s on may be: tried from the longest on, no more than `most`. What is dark before a bright end is left out: s and
// `way` go on behind it.
float longestPanel(Airlight light, Followed followed, Spectrum alive, Spectrum least, float s1, float most, inout float s, inout Way way, inout Way end) {
  float len = min(min(stepFrom(followed, s), s1 - s), most), middle = 0.0; // middle: half of a length whose end is known
  Way whole = way;
  for (int k = 0; k < 12; ++k) {
    end = wayOf(light, s + len);
    if (middle > 0.0 && isDarkBefore(alive, way, end, whole)) {
      s += len;
      way = end;
      end = whole;
      middle = 0.0;
    }
    float change = changeOf(alive, least, way, end);
    if (change <= kDepths) break;
    whole = end;
    middle = change > 0.9 * kDark && change <= kDark ? 0.5 * len : 0.0;
    len = middle > 0.0 ? middle : len * (kDepths / change);
  }
  return len;
}

// One smooth piece of a span, Gauss-Legendre in each of its panels.
void addPiece(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
  Followed followed = followedOf(light.heights, Layers(s0), Layers(s1), lightLengths(light, s0, s1));
  Way way = wayOf(light, s0);
  Spectrum least = way.whole;
  float s = s0, most = 1e30;
  for (int i = 0; i < kMostPanels && s < s1; ++i) {
    Spectrum alive = aliveAt(way, least);
    if (greatestOf(alive) == 0.0) break;
    Way end = way;
    // What light comes through may grow by many e-folds over the longest panel, and its share is then far too short: the next ones grow from
    // there. Never so short that s stays where it is.
    float len = max(longestPanel(light, followed, alive, least, s1, most, s, way, end), min(4e-7 * s, s1 - s));
    most = 4.0 * len;
    float change = changeOf(alive, least, way, end);
    float halfLength = 0.5 * len, middle = s + halfLength;
    bool isShort = change + foldsOver(followed, s, len) < 0.3;
    Spectrum panel = Spectrum(0.0); // a sum of its own, for what a sum of very many nodes would round
    for (int k = 0; k < (isShort ? 2 : 6); ++k) { // nodes in pairs around the middle
      vec2 node = isShort ? vec2(kNode2, 1.0) : k < 2 ? kNode6.xy : k < 4 ? kNode6.zw : kNode6Last;
      panel += node.y * integrandAt(light, middle + ((k & 1) == 0 ? -halfLength : halfLength) * node.x);
    }
    sum += (halfLength * visibility) * Light(panel);
    s += len;
    least = min(least, end.whole);
    way = end;
  }
}

// A span over which the airlight changes little: by its value in the middle and its curvature there. Returns by how much it falls over the
// span, as a share of itself.
Spectrum addShort(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
  float len = s1 - s0, s = 0.5 * (s0 + s1);
  Layers here = light.heights.begin + s * light.heights.slope, slope = len * light.heights.slope * aboveGround(here), density = densities(here);
  // Over the span, since floats do not hold the square of what a dense layer takes a unit of length: what is taken, what that falls by, ...
  Spectrum taken = len * extinctionOf(density), growth = len * layersExtinction(density * slope);
  Spectrum depth = s * extinctionOf(meanDensities(light.heights, here, density)), value = phaseOf(light.phases, density);
  Spectrum folds = layersPhase(light.phases, density * slope), folds2 = layersPhase(light.phases, density * slope * slope);
  Spectrum curve = value * (taken * taken + growth) + 2.0 * taken * folds + folds2;
  sum += visibility * Light(exp(-depth) * len * (value + curve / 24.0));
  return taken + folds / max(value, Spectrum(1e-37));
}

// True if it is such a span: of less than a quarter of an optical depth and e-fold, within one side of each ground, of light that loses nothing
// before the ray.
bool isShort(Airlight light, float s0, float s1) {
  Layers ground = groundExponents(), e0 = light.heights.begin + s0 * light.heights.slope - ground, e1 = light.heights.begin + s1 * light.heights.slope - ground;
  Spectrum rate = extinctionOf(exp(-max(min(e0, e1), 0.0) - ground));
  float changes = (s1 - s0) * (greatestOf(rate) + sumOf(abs(light.heights.slope)));
  return changes < 0.25 && leastOf(e0 * e1) >= 0.0 && boundary == vec4(0.0);
}

void addAirlight(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
  if (!(s1 > s0)) return;
  if (isShort(light, s0, s1)) {
    addShort(light, s0, s1, visibility, sum);
    return;
  }
  // Pieces end at the grounds and at the medium's boundary.
  Layers crossings = groundCrossings(light.heights);
  float bound = light.pathSlope != 0.0 ? -light.path / light.pathSlope : -1.0, from = s0;
  for (int i = 0; i < 4 && from < s1; ++i) {
    float to = pieceEnd(crossings, from, s1);
    if (bound > from) to = min(to, bound);
    addPiece(light, from, to, visibility, sum);
    from = to;
  }
}

#endif
