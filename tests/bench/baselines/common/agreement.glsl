// How well two distances along neighbouring rays agree: 1 if alike, falling off where the inverse distances differ by
// more than a tenth. On a plane the inverse distance is close to linear over the image.
float agreementOf(float end, float other) {
  float change = abs(end - other) / max(other, 1e-20);
  float relative = min(10.0 * change, 1e3);
  return 1.0 / (1.0 + relative * relative * relative * relative);
}

// Rays beyond this distance add nothing: the sky's and all others are alike there.
float comparableEnd(float end) { return max(min(end, visibleEnd), 1e-20); }
