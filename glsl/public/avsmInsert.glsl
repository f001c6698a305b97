// Insertion: what an engine's own shaders put between a light and the scene goes into curves at once, in a fixed memory and in the order of
// drawing (Salvi et al. 2013, 4.1; tyndall/avsm.h). Include it, between Avsm::beginStreaming() and Avsm::resolve(), in
//  - a fragment shader of #version 330 or later with "#extension GL_EXT_shader_framebuffer_fetch : require", drawn into what
//    Avsm::bindCurves() binds, and call tyndallInsert() once at most; it writes all colour outputs; or
//  - a shader of #version 430 or later, TYNDALL_CURVES_IMAGE defined as the image unit to which the engine bound the curves' texture, all
//    layers, to read and write (RGBA32UI), and call tyndallInsertAt() where no two invocations are at one texel at once:
//    in a fragment shader with GL_ARB_fragment_shader_interlock and layout(pixel_interlock_ordered) between beginInvocationInterlockARB()
//    and endInvocationInterlockARB(), or in a compute shader of which one invocation owns a texel.
// Define first, as AvsmCurves says: TYNDALL_CURVE_NODES (4, 8, 12 or 16), TYNDALL_CURVE_PACKED (0 or 1). Packed curves are rounded to 16 bits
// with each segment: one that lets more than 0.99999 through may be lost, so many of these want curves that are not packed.

#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#include "lib/avsmSegment.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmNodes.glsl"
#include "lib/avsmInsert.glsl"

// The arguments are those of tyndallCapture(): entry and exit are linear depth in the light's view, 0 at its near and 1 at its far plane
// (avsmDepth() in tyndall/avsm.h), either may come first; transmittance is 0, for something opaque, to 1. What lies outside the map, or is not
// a finite number, is left out.
#ifdef TYNDALL_CURVES_IMAGE
layout(rgba32ui, binding = TYNDALL_CURVES_IMAGE) coherent uniform uimage2DArray tyndallCurves;

// texel: x and y of the map and its layer.
void tyndallInsertAt(ivec3 texel, float entry, float exit, float transmittance) {
  vec3 segment;
  ivec3 first = ivec3(texel.xy, texel.z * kTyndallTexelsOfCurve);
  if (!tyndallSegment(entry, exit, transmittance, segment)) return;
  if (any(lessThan(texel, ivec3(0))) || any(greaterThanEqual(first, imageSize(tyndallCurves)))) return;
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, imageLoad(tyndallCurves, first + ivec3(0, 0, i)));
  tyndallFindUsed();
  tyndallInsertSegment(segment);
  tyndallPadCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) imageStore(tyndallCurves, first + ivec3(0, 0, i), tyndallTexelFrom(kTyndallNodesOfTexel * i));
}
#else
layout(location = 0) inout uvec4 tyndallTexels[kTyndallTexelsOfCurve];

void tyndallInsert(float entry, float exit, float transmittance) {
  vec3 segment;
  if (!tyndallSegment(entry, exit, transmittance, segment)) return;
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, tyndallTexels[i]);
  tyndallFindUsed();
  tyndallInsertSegment(segment);
  tyndallPadCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTexels[i] = tyndallTexelFrom(kTyndallNodesOfTexel * i);
}
#endif
