// Froxels: slices of the camera's view at exponentially growing distances. Boundary k of n lies at
// far (exp(4 k / n) - 1) / (exp(4) - 1).
uniform float farEnd;
uniform int slices;

const float kGrowth = 4.0;

float boundaryAt(float k) { return farEnd * (exp(kGrowth * k / float(slices)) - 1.0) / (exp(kGrowth) - 1.0); }

float boundaryOf(float s) {
  return float(slices) / kGrowth * log(1.0 + clamp(s / farEnd, 0.0, 1.0) * (exp(kGrowth) - 1.0));
}
