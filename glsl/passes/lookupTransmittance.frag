// Look-up transmittance: layers of a look-up, LOOKUP_LAYERS at once: what the medium leaves of light that comes from their distances.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/lookup.glsl"

layout(location = 0) out vec4 outFirst;
layout(location = 1) out vec4 outSecond;
layout(location = 2) out vec4 outThird;

void main() {
  Ray ray = cameraRay(lookupPosition(gl_FragCoord.xy));
  outFirst = vec4(transmittanceTo(ray, lookupDistance(lookupFirst)), 1.0);
  outSecond = vec4(transmittanceTo(ray, lookupDistance(lookupFirst + 1)), 1.0);
  outThird = vec4(transmittanceTo(ray, lookupDistance(lookupFirst + 2)), 1.0);
}
