// What smoke and hair leave of light on its way to the eye. The light of a ray is added in pieces that are so short that a line stands for the
// transmittance. Needs lib/eyeTexels.glsl, lib/weighted.glsl.

struct EyePath {
  vec2 place;           // of the ray in the map
  vec2 depth;           // of the curves at s: x + s y
  float begin, end;     // of what dims, along the ray; the end is not behind the begin if nothing does
  float passed;         // behind it
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
}

// Mean and first moment of the transmittance from one distance to another.
vec2 eyePassed(float s0, float s1) {
  float nearer = eyePath.depth.x + s0 * eyePath.depth.y, farther = max(eyePath.depth.x + s1 * eyePath.depth.y, nearer + 1e-7);
  vec2 passed = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(eyePath.place, k, weight);
    passed += weight * curveBetween(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, nearer, farther);
  }
  return passed;
}

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
      float piece = from + max(steadyLength(light, s0, s1, from), least);
      to = min(piece > from ? piece : s1, min(eyePath.end, s1));
    }
    vec2 passed = dims ? eyePassed(from, to) : vec2(before ? 1.0 : eyePath.passed, 0.0);
    VisibilityLine own = dimmedBy(partOf(VisibilityLine(mean, moment), s0, s1, from, to), passed);
    own.mean = clamp(own.mean, Visibility(0.0), Visibility(1.0)); // lines are no more than near to what is between 0 and 1, as are their halves
    Visibility most = 0.5 * min(own.mean, 1.0 - own.mean);
    own.moment = clamp(own.moment, -most, most);
    if (passed.x > 0.0) addWeighted(light, from, to, own.mean, own.moment, sum);
    from = to;
  }
}
