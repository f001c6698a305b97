// The integral over a span, lit all along, as a value (lib/airlight.glsl adds it to a sum).
#include "lib/airlight.glsl"

Light airlight(Airlight light, float s0, float s1) {
  Light sum = Light(0.0);
  addAirlight(light, s0, s1, Visibility(1.0), sum);
  return sum;
}
