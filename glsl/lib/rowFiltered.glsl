// The light of a segment along its slice's row where visibility is filtered 2x2 or tinted by glass: what a group's split
// leaves open is looked up in the maps, texel by texel.

uniform sampler2D rowShares; // the groups' means

// Visibility of [walk.u, u] in one texel; u is cut where the ray crosses a stored depth.
Visibility texelVisibility(RowLine line, RowWalk walk, ViewSegment segment, inout float u) {
  VISIT
  vec4 row = rowLine(segment.view, sliceOfRow(line.row));
  vec2 p = row.xy + row.zw * (float(walk.index) + 0.5);
#if FILTER_BILINEAR
  p -= 0.5;
#endif
  // The texel's own sampling point stands for all of it: a line that does not move in x and y.
  Line still;
  still.origin = vec3(p, (line.depth - rowCodeOffset) / rowCodeScale);
  still.slope = vec3(0.0, 0.0, line.slope / rowCodeScale);
  return pieceVisibility(still, cellAt(p, segment.view), segment.view, walk.u, u);
}

// Takes the walk's group of four if `current` holds all through it; else true if its mean stands for it.
bool takeGroup(RowLine line, inout RowWalk walk, float current, out bool averaged) {
  VISIT
  int next = ((walk.index >> 2) + 1) << 2;
  float u = rowEnd(line, walk, next), end = rowDepth(line, u);
  vec4 split = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  float found = boundsVisibility(rowDepth(line, walk.u), end, split.xw);
  averaged = (found == kMixed || current == kAverage) && (walk.index & 3) == 0 && isAverage(line, walk, 1, next, end, split);
#ifdef TINT_SUMS
  if (averaged && current == kAverage) found = kAverage;
#endif
  if (walk.index > line.last || found != current) return false;
  walk = RowWalk(next, u);
  return true;
}

// As a visibility: TINT_SUMS has the light of the stretch.
const Visibility kTinted = Visibility(-1.0);

// The same integral as addTexels, over the slice's row. The inner loop finds the next stretch of equal visibility, or
// one that its average stands for, which ends the stretch before it; each of its turns goes on to the next texel or to a crossing
// in this one, or only ends a stretch.
void addRow(Airlight light, ViewSegment segment, int slice, inout Light sum) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  int first = 0; // index where the stretch begins
  bool done = false;
  while (!done) {
    Visibility mean;
    vec2 span;
    ivec2 indices;
    int average; // the node whose average stands for the stretch, or -2 less the group; -1: it has the one visibility
    bool found = false;
    while (!found && !done) {
      float state = current == kTinted ? kAverage : current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
      Node node;
      float known = walkNodes(line, walk, state, node);
      int nodeEnd = ((walk.index >> 4) + 1) << 4;
      bool taking = treeLevels > 0 && known == kMixed, groupAveraged = false;
      while (taking) taking = takeGroup(line, walk, state, groupAveraged) && walk.index < nodeEnd;
      done = walk.index > line.last;
      groupAveraged = groupAveraged && !done && walk.index < nodeEnd;
      bool averaged = !done && (known == kAverage || groupAveraged);
      float uTexel = rowEnd(line, walk, walk.index + 1), u = uTexel;
      bool look = !done && !averaged && walk.index < nodeEnd; // else the next node's turn
      Visibility visibility = current;
      if (look) visibility = known != kMixed ? Visibility(known) : texelVisibility(line, walk, segment, u);
#ifdef TINT_SUMS
      if (averaged) visibility = kTinted;
      else
#endif
      if (done || averaged) visibility = Visibility(0.0);
      span = vec2(from, walk.u);
      mean = current;
      indices = ivec2(first, walk.index);
      average = -1;
      found = visibility != current && current != Visibility(0.0);
      if (visibility != current) {
        current = visibility;
        from = walk.u;
        first = walk.index;
      }
#ifndef TINT_SUMS
      else if (averaged) {
        int next = groupAveraged ? walk.index + 4 : node.end;
        average = groupAveraged ? -2 - (walk.index >> 2) : node.index;
        span = vec2(walk.u, rowEnd(line, walk, next));
        found = true;
        walk = RowWalk(next, span.y);
        from = walk.u;
        done = walk.index > line.last;
      }
#endif
      if (look && known == kMixed) walk = u < uTexel ? RowWalk(walk.index, u) : RowWalk(walk.index + 1, uTexel);
    }
    if (!found) break;
#ifdef TINT_SUMS
    if (mean == kTinted) {
      sum += tintedLight(line.row, indices.x, indices.y);
      continue;
    }
#endif
    Average weight = Average(mean, Visibility(0.0));
    if (average >= 0) weight = averageAt(average, line.row);
    if (average < -1) weight.mean = Visibility(texelFetch(rowShares, ivec2(-2 - average, line.row), 0).rgb);
    addSpan(light, segment, span.x, span.y, weight.mean, weight.moment, sum);
  }
}
