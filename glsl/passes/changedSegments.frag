// Changed segments: those of which a sample may not be what it was in the last frame. Its inscatter follows from the ends and
// the light of the samples from the begin of its chunk of 64, whose extra samples are packed together, and of the segment
// before that, to the second segment behind it. The others are discarded, so that these can be counted.
// Reads the slice table, sampleEnds, changedEnds (comparesEnds), changedParts (comparesRows). Writes slices x segments: 1.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D changedEnds;
uniform sampler2D changedParts;
layout(location = 0) out vec4 outChanged;

// A ray in a view's texels and depth: homogeneous begin and direction, and where the row of the slice lies.
struct ViewRay {
  vec4 begin, direction;
};

ViewRay viewRay(int view, Ray ray) {
  return ViewRay(shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0));
}

// Index on the row that the ray has reached at s; behind a lamp there is none, and it may be anywhere.
float indexAt(ViewRay ray, vec2 along, float origin, float s) {
  vec4 q = ray.begin + s * ray.direction;
  return q.w > 0.0 ? dot(q.xy, along) / q.w - origin : 3e38;
}

// Widens `range` to the coded depth at which the ray crosses an index; false if it does not.
bool addCrossing(ViewRay ray, vec2 along, float at, inout vec2 range) {
  float p = at * ray.begin.w - dot(ray.begin.xy, along), q = dot(ray.direction.xy, along) - at * ray.direction.w;
  if (q == 0.0 || p * q < 0.0) return false;
  float s = p / q, w = ray.begin.w + s * ray.direction.w;
  if (!(w > 0.0)) return false;
  float depth = (ray.begin.z + s * ray.direction.z) / w * rowCodeScale + rowCodeOffset;
  range = vec2(min(range.x, depth), max(range.y, depth));
  return true;
}

// True if the rays from sample `first` to `last` of a slice, whose ends are as they were, may meet a change of its rows.
bool meetsChange(int slice, int samples, int first, int last) {
  vec4 ends = sliceEnds(slice);
  Ray low = cameraRay(samplePosition(ends, samples, float(first))), high = cameraRay(samplePosition(ends, samples, float(last)));
  for (int view = 0; view < drawnViews; ++view) {
    int parts = (rowTexels(view, slice) + 255) / 256;
    bool any = false;
    for (int part = 0; part < parts; ++part) {
      vec2 bounds = texelFetch(changedParts, ivec2(part, rowOf(view, slice)), 0).rg;
      any = any || bounds.x <= bounds.y;
    }
    if (!any) continue;
    vec4 row = rowLine(view, slice);
    vec2 along = row.zw / dot(row.zw, row.zw);
    float origin = dot(row.xy, along), reach = -3e38;
    ViewRay a = viewRay(view, low), b = viewRay(view, high);
    for (int i = first; i <= last; ++i) {
      ViewRay ray = viewRay(view, cameraRay(samplePosition(ends, samples, float(i))));
      reach = max(reach, indexAt(ray, along, origin, max(texelFetch(sampleEnds, ivec2(slice, i), 0).r, 0.0)));
    }
    for (int part = 0; part < parts; ++part) {
      vec2 bounds = texelFetch(changedParts, ivec2(part, rowOf(view, slice)), 0).rg;
      float begin = 256.0 * float(part);
      if (bounds.x > bounds.y || reach < begin - 1.0) continue;
      // Where both rays cross all of the part, all between them do, at depths between theirs: in front of what it holds, or behind?
      vec2 range = vec2(3e38, -3e38), margin = rowCodeSteps > 0.0 ? vec2(2.0 / rowCodeSteps) : 1e-6 * max(abs(bounds), vec2(1.0)); // of rounding
      bool across = addCrossing(a, along, begin - 1.0 + origin, range) && addCrossing(a, along, begin + 257.0 + origin, range) &&
                    addCrossing(b, along, begin - 1.0 + origin, range) && addCrossing(b, along, begin + 257.0 + origin, range);
      bool before = range.y < bounds.x - margin.x, behind = range.x > bounds.y + margin.y && bounds.y < emptyRowCode;
      if (!across || !(before || behind)) return true;
    }
  }
  return false;
}

void main() {
  int slice = int(gl_FragCoord.x), segment = int(gl_FragCoord.y), samples = sliceSamples(slice);
  int chunk = 64 * (segment >> 2), last = 16 * segment + 48;
  bool changed = slice >= firstRefreshedSlice && slice < endRefreshedSlice;
  for (int i = max(chunk - 18, 0) >> 4; comparesEnds != 0 && i <= min(last + 3, samplesPerSlice - 1) >> 4; ++i)
    changed = changed || texelFetch(changedEnds, ivec2(slice, i), 0).r > 0.0;
  if (comparesRows != 0 && !changed && 16 * segment < samples) changed = meetsChange(slice, samples, max(chunk - 16, 0), min(last, samples - 1));
  if (!changed) discard;
  outChanged = vec4(1.0);
}
