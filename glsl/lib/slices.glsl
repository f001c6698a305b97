// Slices: epipolar lines of the image, each one column of every epipolar texture. A slice runs from its entry into the
// image (or the epipole) to its exit border point; sample j of n lies at j / (n - 1) of the way.

// Width: slices. Row 0: entry xy, exit xy (pixels). Row 1: sample number at a window position p, dot(xy, p) + z, and
// the last sample's number. Rows 2 + 2 v, 3 + 2 v for shadow
// view v: origin xy and step xy of its row (shadow texels; the greater component of the step is rowStep), texels of the row.
uniform sampler2D sliceTable;

vec4 sliceEnds(int slice) { return texelFetch(sliceTable, ivec2(slice, 0), 0); }
int sliceSamples(int slice) { return int(texelFetch(sliceTable, ivec2(slice, 1), 0).w) + 1; }

vec2 samplePosition(vec4 ends, int samples, float index) {
  return mix(ends.xy, ends.zw, index / float(max(samples - 1, 1)));
}

// The slice that runs through a window position, as a real number: slice i has the value i. Nothing divides by the
// epipole's w: the line's direction at p is sign(w) (w p - e.xy), away from the light.
float sliceCoordinate(vec2 p) {
  vec2 d = epipoleSign * (epipole.z * p - epipole.xy);
  vec2 target = mix(border.xy, border.zw, greaterThan(d, vec2(0.0)));
  vec2 steps = mix(vec2(3e38), (target - p) / d, notEqual(d, vec2(0.0)));
  bool throughX = steps.x < steps.y;
  vec2 exit = clamp(p + d * min(min(steps.x, steps.y), 3e37), border.xy, border.zw);
  vec2 size = border.zw - border.xy, local = exit - border.xy;
  // Arc length counter-clockwise from the low corner: bottom, right, top, left.
  float arc = throughX ? (d.x > 0.0 ? size.x + local.y : 2.0 * size.x + size.y + (size.y - local.y))
                       : (d.y > 0.0 ? size.x + size.y + (size.x - local.x) : local.x);
  float along = arc - slicesBegin;
  along += along < 0.0 ? borderLength : 0.0;
  return along / sliceWidth - 0.5;
}

// The two slices around a coordinate; with a closed border the last neighbours the first.
ivec2 neighbourSlices(float coordinate) {
  int low = int(floor(coordinate)), last = sliceCount - 1;
  if (slicesClosed != 0) return ivec2((low + sliceCount) % sliceCount, (low + 1 + sliceCount) % sliceCount);
  return clamp(ivec2(low, low + 1), ivec2(0), ivec2(last));
}
