// A directional light in a medium part of which thins out with height. Included by airlight.glsl.

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
  Spectrum all = max(phases.even + phases.first + phases.second, Spectrum(1e-30));
  phases = Phases(phases.even / all, phases.first / all, phases.second / all);
#endif
  return Airlight(phases, heightsAlong(ray), dot(boundary.xyz, ray.origin) + boundary.w, dot(boundary.xyz, ray.direction));
}

void litRange(Airlight light, inout float s0, inout float s1) {}

// The light's way to the point s and on to the eye.
Way wayOf(Airlight light, float s) {
  vec2 here = light.heights.begin + s * light.heights.slope;
  Spectrum eye = s * extinctionOf(meanDensities(light.heights.begin, here)), whole = eye;
  float path = light.path + s * light.pathSlope;
  if (path > 0.0) whole += path * extinctionOf(meanDensities(here, here - path * exponentSlopes(lightDirection)));
  return Way(eye, whole);
}

// Change of the airlight's logarithm a unit of length, at s, at most.
float rateAt(Airlight light, float s) {
  vec2 exponents = light.heights.begin + s * light.heights.slope, above = vec2(greaterThan(exponents, groundExponents()));
  return greatestOf(extinctionOf(densities(exponents))) * (1.0 + abs(light.pathSlope)) + dot(abs(light.heights.slope), above);
}

// A length from s on over which the airlight changes by about a twentieth in any channel, but more and more where less is left of it.
float steadyLength(Airlight light, float s0, float s1, float s) {
  Spectrum gone = clamp(wayOf(light, s).whole - wayOf(light, s0).whole, Spectrum(0.0), Spectrum(240.0));
  return 0.05 * exp(-0.25 * greatestOf(-gone)) / max(rateAt(light, s), 1e-30);
}

// True if that is sure to be longer: what it takes to tell is little.
bool isSteady(Airlight light, float s, float len) { return len * max(rateAt(light, s), rateAt(light, s + len)) < 0.05; }

// The longest span of [s0, s1] over which a line stands for the airlight: of an optical depth and e-folds of at most `most`.
float evenLength(Airlight light, float most, float s0, float s1) { return most / max(max(rateAt(light, s0), rateAt(light, s1)), 1e-30); }

Spectrum integrandAt(Airlight light, float s) {
  return phaseOf(light.phases, densities(light.heights.begin + s * light.heights.slope)) * exp(-wayOf(light, s).whole);
}

// One smooth piece of a span, Gauss-Legendre in each of its panels.
void addPiece(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  vec2 fall = abs(exponentSlopes(lightDirection)); // e-folds that light comes through, a unit of length
  vec2 lightLength = boundary == vec4(0.0) ? vec2(0.0) : min(1.0 / max(fall, vec2(1e-30)), vec2(max(light.path + max(s0 * light.pathSlope, s1 * light.pathSlope), 0.0)));
  Followed followed = followedOf(light.heights, s0, s1, lightLength);
  Way way = wayOf(light, s0);
  Spectrum least = way.whole;
  float s = s0;
  for (int i = 0; i < kMostPanels && s < s1; ++i) {
    Spectrum alive = aliveAt(way, least);
    if (greatestOf(alive) == 0.0) break;
    float len = min(stepFrom(followed, s), s1 - s);
    Way end = wayOf(light, s + len);
    float change = changeOf(alive, least, way, end);
    if (change > 0.9 * kDark) {
      Way middle = wayOf(light, s + 0.5 * len);
      if (isDarkBefore(alive, way, middle, end)) {
        s += 0.5 * len;
        way = middle;
        continue;
      }
    }
    for (int k = 0; k < 2 && change > kDepths; ++k) { // twice, since most of a change may be at the begin
      len *= kDepths / change;
      end = wayOf(light, s + len);
      change = changeOf(alive, least, way, end);
    }
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

// Where all of the medium follows one layer, and light loses nothing before the ray: what extinction takes is in proportion to what is
// scattered. The integral of density times transmittance is (T(s0) - T(s1)) / sigma.
void addOnlyLayer(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  bool isFirst = onlyLayer == 0;
  float begin = isFirst ? light.heights.begin.x : light.heights.begin.y, slope = isFirst ? light.heights.slope.x : light.heights.slope.y;
  vec4 layer = isFirst ? layerExtinction[0] : layerExtinction[1];
  Spectrum phase = isFirst ? light.phases.first : light.phases.second, sigma = SPECTRUM(layer);
  float before = s0 * meanDensity(begin, begin + s0 * slope, layer.w);
  float own = (s1 - s0) * meanDensity(begin + s0 * slope, begin + s1 * slope, layer.w);
  sum += visibility * Light(phase * exp(-sigma * before) * relativeExpm1(sigma * own) * own);
}

void addAirlight(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  if (!(s1 > s0)) return;
  if (onlyLayer >= 0 && boundary == vec4(0.0)) {
    addOnlyLayer(light, s0, s1, visibility, sum);
    return;
  }
  // Pieces end at the grounds and at the medium's boundary.
  vec2 crossings = groundCrossings(light.heights);
  float bound = light.pathSlope != 0.0 ? -light.path / light.pathSlope : -1.0, from = s0;
  for (int i = 0; i < 4 && from < s1; ++i) {
    float to = s1;
    if (crossings.x > from) to = min(to, crossings.x);
    if (crossings.y > from) to = min(to, crossings.y);
    if (bound > from) to = min(to, bound);
    addPiece(light, from, to, visibility, sum);
    from = to;
  }
}
