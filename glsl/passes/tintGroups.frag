// Tint groups: each low-rank term of the light that crosses four texels of a row, times their tints (Chen 2011, 3.4).
// Reads the slice table, the glass map and lowRankLights. Writes groups x (rows x terms / 4), RGBA32F: four terms, of
// one target a channel; nothing behind a row's end.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"
#include "lib/shadowMap.glsl"
#include "lib/lowRank.glsl"

uniform sampler2D rowDepths; // its height: rows that a draw has room for

layout(location = 0) out vec4 outRed;
layout(location = 1) out vec4 outGreen;
layout(location = 2) out vec4 outBlue;

// The tint of a row's texel behind all panes around it.
vec3 tintAt(vec2 p, int view) {
  ivec2 last = shadowViews[view].size - 1, origin = firstTexel(view);
#if FILTER_BILINEAR
  ivec2 cell = clamp(ivec2(floor(p - 0.5)), ivec2(-1), last), low = max(cell, ivec2(0)), high = min(cell + 1, last);
  vec2 f = clamp(p - 0.5 - vec2(cell), 0.0, 1.0);
  low += origin;
  high += origin;
  return mix(mix(paneTint(low, view), paneTint(ivec2(high.x, low.y), view), f.x),
             mix(paneTint(ivec2(low.x, high.y), view), paneTint(high, view), f.x), f.y);
#else
  return paneTint(clamp(ivec2(floor(p)), ivec2(0), last) + origin, view);
#endif
}

// A camera ray of the slice, which light rays are told by: the end that is farther from the light's direction.
Ray referenceRay(int slice) {
  vec4 ends = sliceEnds(slice);
  Ray a = cameraRay(ends.xy), b = cameraRay(ends.zw);
  vec3 toLight = LIGHT_KIND == 0 ? lightDirection : lightPosition;
  vec3 sineA = cross(toLight, a.direction), sineB = cross(toLight, b.direction);
  if (dot(sineA, sineA) > dot(sineB, sineB)) return a;
  return b;
}

// Where in the grid the light ray lies that bounds a row's texel: it crosses the reference ray at s, p / q.
vec3 placeAt(Ray reference, int view, vec4 row, float index) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(reference.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(reference.direction, 0.0);
  vec2 along = row.zw / dot(row.zw, row.zw);
  float at = index + dot(row.xy, along), p = at * a.w - dot(a.xy, along), q = dot(b.xy, along) - at * b.w;
  float sine = length(cross(LIGHT_KIND == 0 ? lightDirection : normalize(lightPosition), reference.direction));
#if LIGHT_KIND == 0
  return placeOfLight(abs(q) > 0.0 ? p / q * sine : 0.0);
#else
  // The line through the lamp: its half above the line from the lamp to the eye has an angle from 0 to pi.
  float lamp = length(lightPosition), y = p * sine, x = q * lamp - p * dot(lightPosition, reference.direction) / lamp;
  return placeOfLight(y < 0.0 ? atan(-y, -x) : atan(y, x));
#endif
}

void main() {
  int fours = (lowRankTerms + 3) / 4, rows = textureSize(rowDepths, 0).y, four = int(gl_FragCoord.y) / rows, row = int(gl_FragCoord.y) % rows;
  int view = viewOfRow(row), slice = sliceOfRow(row), first = 4 * int(gl_FragCoord.x);
  outRed = outGreen = outBlue = vec4(0.0);
  if (row >= sliceCount * max(drawnViews, 1) || first >= rowTexels(view, slice)) return;
  vec4 line = rowLine(view, slice);
  Ray reference = referenceRay(slice);
  lowRank.set = lowRankPerSlice != 0 ? slice : 0;
  vec3 place = placeAt(reference, view, line, float(first));
  vec4 red = vec4(0.0), green = vec4(0.0), blue = vec4(0.0); // ESSL indexes no output
  for (int k = 1; k <= 4; ++k) {
    vec3 next = placeAt(reference, view, line, float(first + k)), tint = tintAt(line.xy + line.zw * (float(first + k) - 0.5), view);
    for (int i = 0; i < 4; ++i) {
      int term = 4 * four + i;
      if (term >= lowRankTerms) continue;
      vec3 light = tint * vec3(prefixSum(term, next) - prefixSum(term, place));
      red[i] += light.r;
      green[i] += light.g;
      blue[i] += light.b;
    }
    place = next;
  }
  outRed = red;
  outGreen = green;
  outBlue = blue;
}
