// A texel of a volume's density, as it counts: a negative one, or what is no number, as 0.
float cleanedDensity(float value) { return value > 0.0 ? min(value, 1e18) : 0.0; }
