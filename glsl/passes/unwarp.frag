// Unwarp: from slices to pixels, bilinear over two slices and two samples each, each sample weighted by how well its
// distance agrees with the pixel's (Yusov 2013, "Transformation from epipolar to rectangular coordinates"). A pixel that no
// sample serves, or whose samples differ by a share of the picture's mean, is discarded, so that its stencil stays for the
// fix-up. Reads the slice table, sliceBlocks, epipolarInscatter, the scene depth and, with SPREAD 1 (never with COMPOSITE), meanLight. Writes
// inscatter and transmittance as exact.frag does.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"
#include "lib/unwarp.glsl"

uniform sampler2D epipolarInscatter;
#if SPREAD
uniform sampler2D meanLight;
vec3 spreadUnit; // radiance of a unit of stored light at this pixel, as a part of the picture's mean
#endif

#if COMPOSITE
#include "lib/outputs.glsl"
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

// Sums over samples: inscatter and weight of the bilateral filter; inscatter, end coordinate and weight of the plain
// bilinear one; squares of the brightest channel over the picture's mean, times the bilateral weight.
struct Sums {
  vec4 agreeing, plain;
  float plainWeight, squares;
};

// Adds two samples of a slice, bilinearly, and by how far their end coordinates are from the pixel's.
void addSlice(int slice, float sliceWeight, vec2 p, float end, inout Sums sums) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  float y = dot(p, line.xy) + line.z, beyond = max(max(-y, y - line.w), 0.0);
  if (beyond * beyond > dot(line.xy, line.xy)) return; // by more than a pixel: the slice does not come as far
  y = clamp(y, 0.0, line.w);
  int low = min(int(y), max(int(line.w) - 1, 0));
  float f = y - float(low);
  for (int k = 0; k < 2; ++k) {
    vec4 texel = texelFetch(epipolarInscatter, ivec2(slice, low + k), 0);
    float weight = sliceWeight * (k == 0 ? 1.0 - f : f), sampleEnd = storedCoordinate(texel);
    float agreeing = weight * agreementOf(sampleEnd, end);
    sums.agreeing += agreeing * vec4(texel.rgb, 1.0);
#if SPREAD
    float brightest = brightestOf(lightOf(texel.rgb) * spreadUnit);
    sums.squares += agreeing * brightest * brightest;
#endif
    sums.plain += weight * vec4(texel.rgb, sampleEnd);
    sums.plainWeight += weight;
  }
}

// Light of the ray up to an end, as textures hold it, and its weight: less than leastWeight where no sample serves.
vec4 lightTo(float end, Ray ray, vec2 position, float place) {
  float coordinate = endCoordinate(ray, min(end, visibleEnd));
  SlicePair pair = slicesAround(place);
  Sums sums = Sums(vec4(0.0), vec4(0.0), 0.0, 0.0);
  addSlice(pair.columns.x, 1.0 - pair.share, position, coordinate, sums);
  addSlice(pair.columns.y, pair.share, position, coordinate, sums);
  vec4 sum = lightOfSums(sums.agreeing, sums.plain, sums.plainWeight, coordinate);
#if SPREAD
  // Samples that agree with the pixel but not with each other: edges of shadows run between them.
  float least = spreadThreshold * sums.agreeing.w, brightest = brightestOf(lightOf(sums.agreeing.rgb) * spreadUnit);
  if (sums.squares * sums.agreeing.w - brightest * brightest > least * least) return vec4(-1.0);
#endif
  return sum;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 position = unjittered(gl_FragCoord.xy);
  float place = sliceCoordinate(position);
  Ray ray = cameraRay(position);
#if SPREAD
  spreadUnit = radianceUnit(ray) / max(texelFetch(meanLight, ivec2(0), 0).r, 1e-37);
#endif
  float end = max(rayEnd(position, depthAt(pixel)), 0.0);
  vec4 light = lightTo(end, ray, position, place);
  if (isNearLight(position) || !isServed(light)) discard;
  outInscatter = vec4(radianceOf(light, ray), 0.0);
  outTransmittance = vec4(transmittanceTo(ray, end), 1.0);
}
