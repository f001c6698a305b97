// Look-up transmittance: layers of a look-up, LOOKUP_LAYERS at once: what the medium leaves of light that comes from their distances.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#if EYE_CURVES
#include "lib/curveNodes.glsl"
#include "lib/eyeTexels.glsl"
#include "lib/eyeVeil.glsl"
#else
float eyeTransmittance(vec2 position, Ray ray, float s) { return 1.0; }
#endif
#include "lib/lookup.glsl"

layout(location = 0) out vec4 outFirst;
layout(location = 1) out vec4 outSecond;
layout(location = 2) out vec4 outThird;

vec4 passedTo(vec2 position, Ray ray, float s) { return vec4(eyeTransmittance(position, ray, s) * transmittanceTo(ray, s), 1.0); }

void main() {
  vec2 position = lookupPosition(gl_FragCoord.xy);
  Ray ray = cameraRay(position);
  outFirst = passedTo(position, ray, lookupDistance(lookupFirst));
  outSecond = passedTo(position, ray, lookupDistance(lookupFirst + 1));
  outThird = passedTo(position, ray, lookupDistance(lookupFirst + 2));
}
