// March: inscatter of one light, through the shadow views of a draw, along a slice's row and its tree: at the regular march samples, the
// first of each segment; or, isImage, of every pixel or every pixel that unwarp left, by its nearest slice (Chen 2011). SHARES 1: only
// of those pixels, and not where the samples around tell enough (lib/shares.glsl); then epipolarInscatter and meanLight are read, too.
// Reads slice table, row textures and, as sceneDepth, the sampleEnds or the scene depth. Writes marched: slices x segments, light as
// lib/stored.glsl says, R32F (grey) or RGBA16F, added up over the draws, in parts only changedSegments; or as exact.frag does.
#ifdef GL_ARB_shader_image_load_store
#extension GL_ARB_shader_image_load_store : enable
layout(early_fragment_tests) in; // its discard is no reason to shade pixels that the stencil of the fix-up keeps out
#endif
#define ROW_CURVES
#define PHASE_APART
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/row.glsl"

#ifdef SHARES
#include "lib/fromStored.glsl"
#include "lib/openLight.glsl"
#include "lib/shares.glsl"
#include "lib/unwarp.glsl"
#endif

uniform sampler2D changedSegments;
flat in int isImage;
flat in int isPart;
#include "lib/outputs.glsl"

// What is marched: a window position, the slice and where its ray ends; not if `marched` is false.
struct Target {
  vec2 position;
  int slice;
  float end;
  bool marched;
};

Target sampleTarget() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice), index = 16 * int(gl_FragCoord.y);
  bool changed = isPart == 0 || (index < samples && texelFetch(changedSegments, ivec2(slice, index / 16), 0).r > 0.0);
  float end = index < samples ? texelFetch(sceneDepth, ivec2(slice, index), 0).r : 0.0;
  return Target(samplePosition(sliceEnds(slice), samples, float(index)), slice, end, changed);
}

Target pixelTarget() {
  vec2 position = unjittered(gl_FragCoord.xy);
  float end = rayEnd(position, depthAt(ivec2(gl_FragCoord.xy)));
  return Target(position, nearestSlice(sliceCoordinate(position)), end, true);
}

// What depends on the ray's direction alone: the sine by which a sample's light is stored, or the phase function of a pixel's.
Spectrum factorOf(Ray ray) {
  if (isImage == 0) return Spectrum(lampSine(ray));
#if LIGHT_KIND == 0
  return phaseAlong(ray);
#else
  return Spectrum(1.0);
#endif
}

void main() {
  Target target;
  if (isImage == 0) target = sampleTarget();
  else target = pixelTarget();
  if (!target.marched) discard;
  float end = target.marched ? max(target.end, 0.0) : 0.0;
#ifdef SHARES
  vec4 byShares = isNearLight(target.position) ? vec4(0.0) : radianceByShares(target.position, cameraRay(target.position), end);
  outInscatter = vec4(min(byShares.rgb, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(cameraRay(target.position), end), 1.0);
  if (byShares.w > 0.0) return;
#endif
  Light light = rowShadowedLight(target.position, 0.0, end, target.slice);
  Spectrum factor = factorOf(cameraRay(target.position));
  outInscatter = vec4(isImage == 0 ? storedLight(light, vec3(factor).x) : min(lightColour * vec3(factor) * vec3(light), vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(cameraRay(target.position), end), 1.0);
}
