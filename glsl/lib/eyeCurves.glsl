// What smoke and hair leave of light on its way to the eye and, FOG 1, what fog scatters that they stand for. The light of a ray is added in pieces that are
// so short that a line stands for the transmittance; FOG_STEPS: and that so many are in what is lit fog. Needs lib/eyeTexels.glsl, lib/weighted.glsl.

struct EyePath {
  vec2 place;           // of the ray in the map
  vec2 depth;           // of the curves at s: x + s y
  float begin, end;     // of what dims, along the ray; the end is not behind the begin if nothing does
  float passed;         // behind it
  float searched;       // depth up to which all nodes of the curves' texels before `texel` are nearer
  int texel;
#if FOG
  vec3 fog;             // what fog scatters of a light whose direction is one, in the unit of what addAirlight() adds
#endif
} eyePath;

// For the ray through a window position: before any of its light is added.
void startEyePath(vec2 position, Ray ray) {
  eyePath.place = eyePlace(position);
  eyePath.depth = vec2(dot(eyeCurveDepth.xyz, ray.origin) + eyeCurveDepth.w, dot(eyeCurveDepth.xyz, ray.direction));
  vec3 ends = vec3(1.0, 0.0, 0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(eyePath.place, k, weight);
    vec3 own = curveEnds(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel);
    if (own.z < 1.0) ends.xy = vec2(min(ends.x, own.x), max(ends.y, own.y)); // a clear one ends at the far plane
    ends.z += weight * own.z;
  }
  float inverse = 1.0 / eyePath.depth.y;
  eyePath.begin = max((ends.x - eyePath.depth.x) * inverse, 0.0);
  eyePath.end = (ends.y - eyePath.depth.x) * inverse;
  eyePath.passed = ends.z;
  eyePath.searched = 0.0;
  eyePath.texel = 0;
#if FOG
  if (eyePath.end >= eyePath.begin) eyePath.begin = min(eyePath.begin, (1.0 - 1e-4) * eyePath.end); // what is at one depth has a place where it is lit
#if LIGHT_KIND == 0
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  eyePath.fog = fogScattering * fogPhase(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
#ifdef PHASE_APART
  eyePath.fog /= phaseAlong(ray);
#endif
#endif
#endif
}

// From one distance to another: mean and first moment of the transmittance and, FOG 1, the same of what is taken there, a unit of length: the latter from
// the mean transmittance by Simpson's rule. Quick where it begins no nearer than the one before ends.
struct EyePiece {
  vec2 passed;
#if FOG
  vec2 taken;
#endif
};

EyePiece eyePiece(float s0, float s1) {
  float nearer = eyePath.depth.x + s0 * eyePath.depth.y, end = eyePath.depth.x + s1 * eyePath.depth.y, farther = max(end, nearer + 1e-7);
  int first = nearer >= eyePath.searched ? eyePath.texel : 0, next = texelsPerEyeCurve;
  vec2 passed = vec2(0.0);
  vec3 upTo = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(eyePath.place, k, weight);
    int own = first;
    CurvePart part = curvePart(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, nearer, farther, vec3(nearer, 0.5 * (nearer + end), end), own);
    passed += weight * part.passed;
    upTo += weight * part.upTo;
    next = min(next, own);
  }
  eyePath.texel = next;
  eyePath.searched = farther;
#if FOG
  vec2 ends = vec2(s0 <= eyePath.begin ? 1.0 : upTo.x, s1 < eyePath.end ? upTo.z : eyePath.passed);
  float taken = max(ends.x - ends.y, 0.0), moment = (ends.x + 4.0 * upTo.y + ends.y) / 3.0 - ends.x - ends.y;
  return EyePiece(passed, vec2(taken, clamp(moment, -0.5 * taken, 0.5 * taken)) / max(s1 - s0, 1e-30));
#else
  return EyePiece(passed);
#endif
}

#if FOG

// The same light as fog scatters it, alone.
Airlight ofFog(Airlight light) {
#if LIGHT_KIND == 0 && HEIGHT
  light.phases.even = eyePath.fog;
  light.phases.first = Spectrum(0.0);
#if HEIGHT > 2
  light.phases.second = Spectrum(0.0);
#endif
#elif LIGHT_KIND == 0
  light.phase = eyePath.fog;
#endif
  return light;
}

// How long a stretch may be that is taken as a whole: not so long that it tells nothing of where in fog light is.
float evenInFog(float len) { return eyePath.end > eyePath.begin ? min(len, (eyePath.end - eyePath.begin) / 64.0) : len; }

#endif

const float kEyePieces = 256.0; // of what dims, at most: where light changes fast

// How far from s on the transmittance changes by little: for what takes light in pieces of its own.
float eyeSteadyLength(float s) {
  float piece = max((eyePath.end - eyePath.begin) / 64.0, 1e-6 * s); // also where all but no way is left to the begin
  return s < eyePath.end ? max(eyePath.begin - s, piece) : 1e30;
}

// A span's light as it comes to the eye.
void addSeen(Airlight light, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) {
  float from = s0, least = (eyePath.end - eyePath.begin) / kEyePieces;
  while (from < s1) {
    bool before = from < eyePath.begin, dims = !before && from < eyePath.end;
    float to = before ? min(eyePath.begin, s1) : s1;
    if (dims) {
      float steady = from + max(steadyLength(light, s0, s1, from), least);
#if FOG && defined(FOG_STEPS)
      steady = min(steady, from + (eyePath.end - eyePath.begin) / FOG_STEPS);
#endif
      to = min(steady > from ? steady : s1, min(eyePath.end, s1));
    }
    EyePiece piece;
    piece.passed = vec2(before ? 1.0 : eyePath.passed, 0.0);
    if (dims) piece = eyePiece(from, to);
    VisibilityLine line = partOf(VisibilityLine(mean, moment), s0, s1, from, to), own = dimmedBy(line, piece.passed);
    own.mean = clamp(own.mean, Visibility(0.0), Visibility(1.0)); // lines are no more than near to what is between 0 and 1, as are their halves
    Visibility most = 0.5 * min(own.mean, 1.0 - own.mean);
    own.moment = clamp(own.moment, -most, most);
#if FOG
    // What the medium scatters, and then what fog does: one loop, since compilers write what is in it as often as it is called.
    Weight weight = mediumScatters * own.mean, weightMoment = mediumScatters * own.moment;
    Airlight scattered = light;
    bool more = true;
    while (more) {
      if (weight != Weight(0.0)) addWeighted(scattered, from, to, weight, weightMoment, sum);
      more = dims && !scattersInFog;
      scattersInFog = more;
      if (more) {
        VisibilityLine lit = dimmedBy(line, piece.taken);
        weight = Weight(max(lit.mean, Visibility(0.0)));
        weightMoment = clamp(Weight(lit.moment), -0.5 * weight, 0.5 * weight);
        scattered = ofFog(light);
      }
    }
#else
    if (piece.passed.x > 0.0) addWeighted(light, from, to, own.mean, own.moment, sum);
#endif
    from = to;
  }
}
