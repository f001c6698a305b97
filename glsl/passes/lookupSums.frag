// Look-up sums: layers of a look-up, LOOKUP_LAYERS at once: all that lookupSteps holds up to them, to no more than the format does.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/lookup.glsl"

uniform sampler2D lookupSteps;
layout(location = 0) out vec4 outFirst;
layout(location = 1) out vec4 outSecond;
layout(location = 2) out vec4 outThird;

vec3 stepTo(int layer) { return texelFetch(lookupSteps, ivec2(gl_FragCoord.xy) + lookupTile(min(layer, lookupDepths - 1)), 0).rgb; }
vec4 capped(vec3 light) { return vec4(min(light, vec3(outputMax)), 1.0); }

void main() {
  vec3 sum = vec3(0.0);
  for (int layer = 0; layer <= lookupFirst; ++layer) sum += stepTo(layer);
  outFirst = capped(sum);
  outSecond = capped(sum += stepTo(lookupFirst + 1));
  outThird = capped(sum += stepTo(lookupFirst + 2));
}
