// What smoke and hair leave of light on its way to the eye (Frame::eyeCurves): the curves of an adaptive volumetric shadow map that was
// captured from the eye, so that along a camera ray it is always the same four that are weighted bilinearly. The light of the ray is added
// in pieces that are so short that a line stands for the transmittance. Needs lib/curveNodes.glsl, lib/weighted.glsl.

uniform usampler2DArray eyeCurves;

struct EyePath {
  vec2 place;           // of the ray in the map, texels
  vec2 depth;           // of the curves at s: x + s y
  float begin, end;     // of what dims, along the ray
  float passed;         // behind it
} eyePath;

// Of the four texels around a place in the map the k-th, and its weight.
ivec3 eyeTexel(int k, out float weight) {
  vec2 at = eyePath.place - 0.5, low = floor(at), f = at - low;
  ivec2 step = ivec2(k & 1, k >> 1);
  vec2 weights = mix(1.0 - f, f, vec2(step));
  weight = weights.x * weights.y;
  return ivec3(clamp(ivec2(low) + step, ivec2(0), ivec2(eyeCurvesSize - 1)), 0);
}

// For the ray through a window position: before any of its light is added.
void startEyePath(vec2 position, Ray ray) {
  eyePath.place = (position + jitter) / vec2(frameSize) * float(eyeCurvesSize);
  eyePath.depth = vec2(dot(eyeCurveDepth.xyz, ray.origin) + eyeCurveDepth.w, dot(eyeCurveDepth.xyz, ray.direction));
  vec3 ends = vec3(1.0, 0.0, 0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    vec3 own = curveEnds(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, eyeTexel(k, weight));
    ends = vec3(min(ends.x, own.x), max(ends.y, own.y), ends.z + weight * own.z);
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
    ivec3 texel = eyeTexel(k, weight);
    passed += weight * curveBetween(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, nearer, farther);
  }
  return passed;
}

// How far from s on the transmittance changes by little.
float eyeSteadyLength(float s) {
  return s < eyePath.begin ? eyePath.begin - s : s < eyePath.end ? max((eyePath.end - eyePath.begin) / 64.0, 1e-6 * s) : 1e30;
}

#ifdef ROW_CURVES
const float kEyePieces = 32.0; // of what dims, at most
#else
const float kEyePieces = 256.0;
#endif

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
    if (passed.x > 0.0) addWeighted(light, from, to, own.mean, own.moment, sum);
    from = to;
  }
}
