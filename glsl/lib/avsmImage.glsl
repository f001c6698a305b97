// The curves' texture as an image. Needs lib/avsmCurve.
#include "lib/avsmNodes.glsl"

#ifndef CURVES_ACCESS
#define CURVES_ACCESS writeonly
#endif
layout(rgba32ui, binding = 0) CURVES_ACCESS uniform uimage2DArray curveImage;

ivec3 placeOf(ivec3 texel, int i) { return ivec3(texel.xy, texel.z * kTyndallTexelsOfCurve + i); }

void storeCurve(ivec3 texel) {
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) imageStore(curveImage, placeOf(texel, i), tyndallTexelFrom(kTyndallNodesOfTexel * i));
}
