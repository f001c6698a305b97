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

// What passes behind all that is there.
float eyePassedBehind(vec2 place) {
  float passed = 0.0;
  for (int k = 0; k < 4; ++k) {
    float weight;
    ivec3 texel = eyeTexel(place, k, weight);
    passed += weight * curveNodes(eyeCurves, texelsPerEyeCurve, eyeCurvesPacked, texel, texelsPerEyeCurve - 1).passed.w;
  }
  return passed;
}
