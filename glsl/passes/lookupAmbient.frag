// Look-up ambient: light of the surroundings between two layers of a look-up, as ambient.frag has it. Reads occlusion. Writes lookupSteps.
#define NO_BOUNDARY
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/ambient.glsl"
#include "lib/lookup.glsl"

layout(location = 0) out vec4 outInscatter;

void main() {
  LookupPart part = lookupPart();
  vec3 sum = vec3(0.0);
  if (part.to > part.from) addAmbient(ambientLightOf(part.position), part.from, min(part.to, visibleEnd), sum);
  outInscatter = vec4(occlusionAt(part.position + jitter) * min(ambientScale * sum, vec3(lightCeiling)), 0.0);
}
