// The engine's depth as it comes: which of its texels shows a pixel, and what its value means to lib/camera.glsl.

ivec2 depthTexel(ivec2 pixel) { return depthFirst + (2 * pixel + 1) * depthSize / (2 * frameSize); }

// The distance that a value stands for: from the eye, along the view's axis or not; orthographic, from the near plane.
float encodedDistance(float depth) {
  if (depthEncoding != 3) return depthUnit * depth + depthZero;
  float x = 0.69314718 * depthUnit * depth; // e^x - 1, also where 1 would swallow it
  return depthZero * (abs(x) < 0.1 ? x * (1.0 + x * (0.5 + x * (0.16666667 + x * 0.041666667))) : exp2(depthUnit * depth) - 1.0);
}

// At a map's own end there is nothing, wherever the far plane is.
bool isEncodedSky(float depth) { return depthEncoding == 3 ? depth >= 1.0 : depth == 1.0 && depthUnit != 1.0; }

// What a value is to rayEnd(): window depth itself, of other encodings t, which is 0 for the sky, or, orthographic, the share of the
// volume before it, 1 for the sky. NaN stays what it is.
float plainDepth(vec2 windowPosition, float depth) {
  if (depthEncoding == 0) return depth;
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  float end = encodedDistance(depth);
  if (isOrthographic != 0) {
    float share = -end / dot(depthAxis, nearStep.xyz);
    return isEncodedSky(depth) || 1.0 - share <= skyRounding ? 1.0 : share;
  }
  if (isEncodedSky(depth)) return 0.0;
  if (end <= 0.0) return 1e30; // at the eye
  float beyond = (depthEncoding == 2 ? length(far.xyz) : dot(depthAxis, far.xyz)) / end - far.w;
  return beyond <= skyRounding * far.w ? 0.0 : beyond / nearStep.w;
}
