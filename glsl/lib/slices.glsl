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

// With a sliceTarget sliceCount of them at most are drawn, chosen from candidateSlices: of each block of eight one, two, four or all,
// evenly apart from its first on. Columns of epipolar textures are those that are drawn, in their order. Of each block: its first
// column, slices that are drawn of it, the column that follows; behind all blocks, how many columns there are. Width: blocks + 1.
uniform sampler2D sliceBlocks;

int drawnColumns() { return sliceTarget > 0.0 ? int(texelFetch(sliceBlocks, ivec2(candidateSlices / SLICE_BLOCK, 0), 0).r) : sliceCount; }

// With a closed border the last slice neighbours the first; at an open one the last stands for those beyond.
int wrapped(int column, int columns) { return slicesClosed != 0 ? (column + columns) % columns : clamp(column, 0, columns - 1); }

// The columns of the two slices around a coordinate, where all are drawn.
ivec2 neighbourSlices(float coordinate) {
  int low = int(floor(coordinate));
  return ivec2(wrapped(low, sliceCount), wrapped(low + 1, sliceCount));
}

// The columns of the two slices that are drawn around a coordinate, how far it lies from the first to the second, and by how many slices
// they are apart.
struct SlicePair {
  ivec2 columns;
  float share;
  int apart;
};

SlicePair slicesAround(float coordinate) {
  if (sliceTarget == 0.0) return SlicePair(neighbourSlices(coordinate), coordinate - floor(coordinate), 1);
  float x = coordinate < 0.0 && slicesClosed != 0 ? coordinate + float(candidateSlices) : max(coordinate, 0.0);
  int block = min(int(x) / SLICE_BLOCK, candidateSlices / SLICE_BLOCK - 1);
  ivec3 own = ivec3(texelFetch(sliceBlocks, ivec2(block, 0), 0).rgb);
  float place = (x - float(SLICE_BLOCK * block)) * float(own.y) / float(SLICE_BLOCK);
  int before = min(int(place), own.y - 1), low = own.x + before;
  return SlicePair(ivec2(low, before + 1 < own.y ? low + 1 : own.z), min(place - float(before), 1.0), SLICE_BLOCK / own.y);
}

int nearestSlice(float coordinate) {
  SlicePair pair = slicesAround(coordinate);
  return pair.share < 0.5 ? pair.columns.x : pair.columns.y;
}
