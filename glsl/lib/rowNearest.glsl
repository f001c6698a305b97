// The light of a segment along its slice's row, nearest texels: visibility is 0 or 1, and a texel's own depth decides.

// Looks at the walk's texel and those behind it in its group of four for the first change of visibility; `at` is where.
bool changeInGroup(RowLine line, inout RowWalk walk, bool lit, inout float at) {
  VISIT
  vec4 depths = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  int first = walk.index & ~3;
  bool changed = false;
  for (int k = 0; k < 4; ++k) {
    float u = rowEnd(line, walk, first + k + 1), end = rowDepth(line, u);
    bool litIn = walk.depth <= depths[k], litOut = end <= depths[k];
    bool here = !changed && first + k == walk.index && walk.index <= line.last;
    changed = changed || (here && (litIn != lit || litOut != lit));
    // A change at the texel's begin leaves the walk there, to be looked at again in the new state.
    if (here && litIn != lit) at = walk.u;
    if (here && litIn == lit) {
      if (changed) at = clamp((depths[k] - line.depth) / line.slope, walk.u, u);
      walk = RowWalk(first + k + 1, u, end);
    }
  }
  return changed;
}

// The same integral as segmentLight, over the slice's row. The inner loop finds the next lit span, or a node that its
// average stands for, which ends a lit span before it.
Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  Light sum = Light(0.0);
  bool lit = false, done = false;
  float from = 0.0;
  while (!done) {
    vec2 span = vec2(0.0);
    Average weight = Average(1.0, 0.0);
    while (!done && span.y == 0.0) {
      int nodeEnd = 0, average = 0;
      float found = walkNodes(line, walk, lit ? 1.0 : 0.0, nodeEnd, average), at = walk.u;
      done = walk.index > line.last;
      bool averaged = !done && !lit && found == kAverage, changed = !done && !averaged && found != kMixed;
      if (averaged) {
        float u = rowEnd(line, walk, nodeEnd);
        span = vec2(walk.u, u);
        weight = averageAt(average, line.row);
        advanceRow(line, walk, nodeEnd, u);
        done = walk.index > line.last;
      } else if (!done && !changed) {
        changed = changeInGroup(line, walk, lit, at);
      }
      if (lit && (changed || done)) span = vec2(from, done ? 1.0 : at);
      if (changed) {
        lit = !lit;
        from = at;
      }
    }
    sum += spanLight(light, segment, span.x, span.y, weight.mean, weight.moment);
  }
  return sum;
}
