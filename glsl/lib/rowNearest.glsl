// The light of a segment along its slice's row, nearest texels: visibility is 0 or 1, and a texel's own depth decides.

// Walks on to the first texel of the walk's group of four in which the visibility is not the same all along; `at` is where it changes. A
// change at the texel's begin leaves the walk there, to be looked at again in the new state.
bool changeInGroup(RowLine line, inout RowWalk walk, bool lit, inout float at) {
  VISIT
  vec4 depths = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  int first = walk.index & ~3, end = min(first + 4, line.last + 1), change = end;
  float from = rowDepth(line, walk.u);
  for (int k = 0; k < 4; ++k) {
    float to = rowDepth(line, rowEnd(line, walk, first + k + 1));
    bool kept = lit ? max(from, to) <= depths[k] : min(from, to) > depths[k];
    if (!kept && first + k >= walk.index) change = min(change, first + k);
    from = to;
  }
  if (change > walk.index) walk = RowWalk(change, rowEnd(line, walk, change));
  if (change == end) return false;
  int k = change & 3;
  float depth = k < 2 ? (k == 0 ? depths.x : depths.y) : (k == 2 ? depths.z : depths.w);
  at = walk.u;
  if (rowDepth(line, walk.u) <= depth != lit) return true;
  float u = rowEnd(line, walk, change + 1);
  at = clamp((depth - line.depth) / line.slope, walk.u, u);
  walk = RowWalk(change + 1, u);
  return true;
}

// The same integral as addTexels, over the slice's row. The inner loop finds the next lit span, or a node that its
// average stands for, which ends a lit span before it.
void addRow(Airlight light, ViewSegment segment, int slice, inout Light sum) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  bool lit = false;
  float from = 0.0;
  while (walk.index <= line.last || lit) {
    vec2 span;
    int average; // the node whose average stands for the span; -1: it is lit
    bool found = false;
    while (!found && (walk.index <= line.last || lit)) {
      Node node;
      float visibility = walkNodes(line, walk, lit ? 1.0 : 0.0, node), at = walk.u;
      bool isAveraged = walk.index <= line.last && visibility == kAverage && !lit;
      bool changed = !isAveraged && (visibility != kMixed || walk.index > line.last); // the row's end is that of a lit span
      average = isAveraged ? node.index : -1;
      if (isAveraged) {
        from = at;
        at = rowEnd(line, walk, node.end);
        walk = RowWalk(node.end, at);
      } else if (!changed) {
        changed = changeInGroup(line, walk, lit, at);
      }
      span = vec2(from, at);
      found = isAveraged || (changed && lit);
      if (changed) from = at;
      lit = lit != changed;
    }
    if (!found) break;
    Average weight = Average(1.0, 0.0);
    if (average >= 0) weight = averageAt(average, line.row);
    addSpan(light, segment, span.x, span.y, weight.mean, weight.moment, sum);
  }
}
