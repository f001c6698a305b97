// (1 - exp(-x)) / x for x >= 0: a series where the difference would cancel.
float relativeExpm1(float x) {
  if (x < 0.5) {
    return 1.0 + x * (-1.0 / 2.0 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0 + x * (-1.0 / 720.0 +
                 x * (1.0 / 5040.0 + x * (-1.0 / 40320.0)))))));
  }
  return (1.0 - exp(-x)) / x;
}
vec3 relativeExpm1(vec3 x) { return vec3(relativeExpm1(x.x), relativeExpm1(x.y), relativeExpm1(x.z)); }
