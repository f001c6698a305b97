// Runs of changed strips of kWidth lines, of up to kRun strips: one rectangle is drawn for each, since the pixels along the diagonal
// between a rectangle's two triangles are shaded twice. Needs kWidth, bool isDrawn(strip), and PARTS, which of a
// table's ranges of texels are meant: rg, those that are compared and kept, in parts of 256, or ba, those that are drawn.

uniform sampler2D changedSlices;
bool isDrawn(int strip);

const int kRun = 8;

// What of a row is drawn, as shares of its length, from and to: nothing, all, or, by a table that says so of each view, the texels that an
// object can have changed.
vec2 partsOf(int line) {
  ivec2 at = ivec2(line % sliceCount, 0);
  if (textureSize(changedSlices, 0).y == 1) return vec2(0.0, texelFetch(changedSlices, at, 0).b);
  at.y = 1 + line / sliceCount;
  return texelFetch(changedSlices, at, 0).PARTS / float(rowLength);
}

// Of both, where neither may be empty.
vec2 unionOf(vec2 a, vec2 b) { return a.x >= a.y ? b : b.x >= b.y ? a : vec2(min(a.x, b.x), max(a.y, b.y)); }

// Of a strip's rows: those of eight slices that share what has changed, or, where eight does not divide the slices, also the last slices of a
// view and those before and behind them.
vec2 partsOfStrip(int strip) {
  vec2 parts = partsOf(kWidth * strip);
  if (sliceCount % kWidth == 0) return parts;
  for (int line = kWidth * strip + 1; line < min(kWidth * (strip + 1), drawnViews * sliceCount); ++line) parts = unionOf(parts, partsOf(line));
  return parts;
}

// Of a run's.
vec2 partsOfRun(ivec2 run) {
  vec2 parts = vec2(0.0);
  for (int strip = run.x; strip < run.y; ++strip) parts = unionOf(parts, partsOfStrip(strip));
  return min(parts, vec2(1.0));
}

// The run that begins at a strip, from and to; nothing if none does.
ivec2 runFrom(int strip, int strips) {
  if (!isDrawn(strip) || ((strip & (kRun - 1)) != 0 && isDrawn(strip - 1))) return ivec2(strip);
  int end = strip + 1;
  while (end < strips && (end & (kRun - 1)) != 0 && isDrawn(end)) ++end;
  return ivec2(strip, end);
}
