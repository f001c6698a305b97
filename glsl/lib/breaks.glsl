// Depth breaks and creases along a slice, from the ends of neighbouring samples; negative: there is no such sample.

// On a plane the inverse distance is close to linear along a line of the image. A break is where neither side's line
// predicts the other sample.
bool isBreak(float before, float low, float high, float after) {
  float a = 1.0 / max(low, 1e-30), b = 1.0 / max(high, 1e-30);
  float allowed = breakThreshold * min(a, b);
  if (abs(b - a) <= allowed) return false;
  if (max(a, b) > 1.5 * min(a, b)) return true; // far towards a horizon the inscatter is not linear any more
  float fromLow = before >= 0.0 ? 2.0 * a - 1.0 / max(before, 1e-30) : a;
  float fromHigh = after >= 0.0 ? 2.0 * b - 1.0 / max(after, 1e-30) : b;
  return min(abs(fromLow - b), abs(fromHigh - a)) > allowed;
}

// A crease is where the surface turns, and with it how much of a shaft lies before it: a line through its neighbours does
// not predict a sample.
bool isCrease(float before, float middle, float after) {
  if (before < 0.0 || after < 0.0) return false;
  float a = 1.0 / max(before, 1e-30), b = 1.0 / max(middle, 1e-30), c = 1.0 / max(after, 1e-30);
  return abs(a - 2.0 * b + c) > 0.125 * breakThreshold * b;
}
