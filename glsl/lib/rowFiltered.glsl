// The light of a segment along its slice's row where visibility is filtered 2x2 or tinted by glass: what a group's split
// leaves open is looked up in the maps, texel by texel.

uniform sampler2D rowShares; // the groups' means

// Visibility of [walk.u, u] in one texel; u is cut where the ray crosses a stored depth.
Visibility texelVisibility(RowLine line, RowWalk walk, ViewSegment segment, inout float u) {
  VISIT
  vec2 p = line.origin + line.step * (float(walk.index) + 0.5);
#if FILTER_BILINEAR
  p -= 0.5;
#endif
  // The texel's own sampling point stands for all of it: a line that does not move in x and y.
  Line still;
  still.origin = vec3(p, segment.p0.z);
  still.slope = vec3(0.0, 0.0, segment.p1.z - segment.p0.z);
  ivec2 cell = clamp(ivec2(floor(p)), ivec2(FILTER_BILINEAR == 1 ? -1 : 0), shadowMapSize - 1);
  return pieceVisibility(still, cell, segment.view, walk.u, u);
}

// Takes the walk's group of four if `current` holds all through it; else true if its mean stands for it.
bool takeGroup(RowLine line, inout RowWalk walk, float current, out bool averaged) {
  VISIT
  int next = ((walk.index >> 2) + 1) << 2;
  float u = rowEnd(line, walk, next), end = rowDepth(line, u);
  vec4 split = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  float found = boundsVisibility(walk.depth, end, split.xw);
  averaged = (found == kMixed || current == kAverage) && (walk.index & 3) == 0 && isAverage(line, walk, 1, next, end, split);
#ifdef TINT_SUMS
  if (averaged && current == kAverage) found = kAverage;
#endif
  if (walk.index > line.last || found != current) return false;
  walk = RowWalk(next, u, end);
  return true;
}

// As a visibility: TINT_SUMS has the light of the stretch.
const Visibility kTinted = Visibility(-1.0);

// The same integral as segmentLight, over the slice's row. The inner loop finds the next stretch of equal visibility, or
// one that its average stands for, which ends the stretch before it.
Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  int guard = (8 + 4 * GLASS) * (line.last - walk.index + 1) + 16; // bounds the loops whatever the arithmetic does
  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  int first = 0; // index where the stretch begins
  bool done = false;
  while (!done) {
    Average weight = Average(Visibility(0.0), Visibility(0.0));
    vec2 span = vec2(0.0);
    ivec2 indices = ivec2(0);
    while (!done && weight.mean == Visibility(0.0)) {
      float state = current == kTinted ? kAverage : current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
      int averageEnd = 0, average = 0, nodeEnd;
      float found = walkNodes(line, walk, state, averageEnd, average);
      nodeEnd = ((walk.index >> 4) + 1) << 4;
      bool taking = treeLevels > 0 && found == kMixed, groupAveraged = false;
      while (taking) taking = takeGroup(line, walk, state, groupAveraged) && walk.index < nodeEnd;
      done = walk.index > line.last || guard <= 0;
      groupAveraged = groupAveraged && !done && walk.index < nodeEnd;
      bool averaged = !done && (found == kAverage || groupAveraged);
      float uTexel = rowEnd(line, walk, walk.index + 1), u = uTexel;
      bool look = !done && !averaged && walk.index < nodeEnd; // else the next node's turn
      Visibility visibility = current;
      if (look) visibility = found != kMixed ? Visibility(found) : texelVisibility(line, walk, segment, u);
#ifdef TINT_SUMS
      if (averaged) visibility = kTinted;
      else
#endif
      if (done || averaged) visibility = Visibility(0.0);
      if (visibility != current) {
        weight.mean = current;
        span = vec2(from, walk.u);
        indices = ivec2(first, walk.index);
        current = visibility;
        from = walk.u;
        first = walk.index;
      }
#ifndef TINT_SUMS
      else if (averaged) {
        int next = groupAveraged ? walk.index + 4 : averageEnd;
        weight.mean = Visibility(texelFetch(rowShares, ivec2(walk.index >> 2, line.row), 0).rgb);
        if (!groupAveraged) weight = averageAt(average, line.row);
        span = vec2(walk.u, rowEnd(line, walk, next));
        advanceRow(line, walk, next, span.y);
        from = walk.u;
        done = walk.index > line.last;
      }
#endif
      --guard;
      if (look && found == kMixed) {
        if (u < uTexel) advanceRow(line, walk, walk.index, u);
        else advanceRow(line, walk, walk.index + 1, uTexel);
      }
    }
#ifdef TINT_SUMS
    if (weight.mean == kTinted) {
      sum += tintedLight(line.row, indices.x, indices.y);
      continue;
    }
#endif
    sum += spanLight(light, segment, span.x, span.y, weight.mean, weight.moment);
  }
  return sum;
}
