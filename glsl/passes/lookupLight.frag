// Look-up light: inscatter of one light, through the shadow views of a draw, between two layers of a look-up, along the row of the nearest
// slice and its tree. Reads slice table and row textures. Writes lookupSteps (lib/lookup.glsl), added up over lights and draws.
#define ROW_CURVES
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/row.glsl"
#include "lib/lookup.glsl"

layout(location = 0) out vec4 outInscatter;

void main() {
  LookupPart part = lookupPart();
  Light light = rowShadowedLight(part.position, part.from, part.to, nearestSlice(sliceCoordinate(part.position)));
  outInscatter = vec4(min(lightColour * vec3(light), vec3(lightCeiling)), 0.0);
}
