// Curves that were captured from the eye (Frame::eyeCurves): along a camera ray it is always the same four that are weighted bilinearly.
// Needs lib/curveNodes.glsl.

uniform usampler2DArray eyeCurves;

// Of a window position, in texels.
vec2 eyePlace(vec2 position) { return position / vec2(frameSize) * float(eyeCurvesSize); }

// Of the four texels around a place the k-th, and its weight.
ivec3 eyeTexel(vec2 place, int k, out float weight) {
  vec2 at = place - 0.5, low = floor(at), f = at - low;
  ivec2 step = ivec2(k & 1, k >> 1);
  vec2 weights = mix(1.0 - f, f, vec2(step));
  weight = weights.x * weights.y;
  return ivec3(clamp(ivec2(low) + step, ivec2(0), ivec2(eyeCurvesSize - 1)), 0);
}

// What passes on the whole, a mean over depth from the near to the far plane, and behind all that is there: what a place's curves are told by.
vec2 eyePassedAt(vec2 place) {
  vec2 passed = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(place, k, weight);
    float mean = curveBetween(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, 0.0, 1.0).x;
    passed += weight * vec2(mean, curveEnds(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel).z);
  }
  return passed;
}

// What passes at a place up to a depth.
float eyePassedUpTo(vec2 place, float depth) {
  float passed = 0.0;
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(place, k, weight);
    passed += weight * curveUpTo(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, depth);
  }
  return passed;
}
