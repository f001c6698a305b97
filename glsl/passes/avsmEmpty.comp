// AVSM empty: curves through which all light passes. Writes curves.
#define TYNDALL_CURVE_ROOM TYNDALL_CURVE_NODES
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(texel.xy, imageSize(curveImage).xy))) return;
  tyndallEmptyCurve();
  tyndallPadCurve();
  storeCurve(texel);
}
