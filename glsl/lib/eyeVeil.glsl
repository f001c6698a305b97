// What fog before the eye leaves of the picture behind. Needs lib/camera.glsl, lib/eyeTexels.glsl.

// Up to s along the ray through a window position.
float eyeTransmittance(vec2 position, Ray ray, float s) {
  if (fogDimsBackground == 0) return 1.0;
  return eyePassedUpTo(eyePlace(position), dot(eyeCurveDepth.xyz, ray.origin) + eyeCurveDepth.w + s * dot(eyeCurveDepth.xyz, ray.direction));
}
