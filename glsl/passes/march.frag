// March: inscatter of one light, through the shadow views of a draw, along a slice's row and its tree: at the regular march samples, the
// first of each segment; or, isImage, of every pixel or every pixel that unwarp left, by its nearest slice (Chen 2011).
// Reads slice table, row textures and sampleEnds or the scene depth. Writes marched: slices x segments, light as
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

uniform sampler2D sampleEnds;
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
  float end = index < samples ? texelFetch(sampleEnds, ivec2(slice, index), 0).r : 0.0;
  return Target(samplePosition(sliceEnds(slice), samples, float(index)), slice, end, changed);
}

Target pixelTarget() {
  float end = rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy)));
  return Target(gl_FragCoord.xy, neighbourSlices(sliceCoordinate(gl_FragCoord.xy) + 0.5).x, end, true);
}

vec3 phaseOf(Ray ray) {
#if LIGHT_KIND == 0
  return vec3(phaseAlong(ray));
#else
  return vec3(1.0);
#endif
}

void main() {
  Target target = pixelTarget();
  if (isImage == 0) target = sampleTarget();
  Ray ray = cameraRay(target.position);
  if (!target.marched) discard;
  float end = target.marched ? max(target.end, 0.0) : 0.0;
  Light light = rowShadowedLight(ray, 0.0, end, target.slice);
  outInscatter = vec4(storedLight(light, ray), 0.0);
  if (isImage != 0) outInscatter = vec4(min(lightColour * phaseOf(ray) * vec3(light), vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(end), 1.0);
}
