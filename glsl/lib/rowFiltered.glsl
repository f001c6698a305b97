// The light of a segment along its slice's row where visibility is filtered 2x2 or tinted by glass: what a group's bounds
// leave open is looked up in the maps, texel by texel.

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
  ivec2 cell = clamp(ivec2(floor(p)), ivec2(FILTER_BILINEAR == 1 ? -1 : 0), viewCounts.zw - 1);
  return pieceVisibility(still, cell, segment.view, walk.u, u);
}

// The walk's group of four, if `current` holds all through it.
bool takeGroup(RowLine line, inout RowWalk walk, int slice, float current) {
  VISIT
  int next = ((walk.index >> 2) + 1) << 2;
  float u = rowEnd(line, walk, next);
  vec2 bounds = texelFetch(rowDepths, ivec2(walk.index >> 2, slice), 0).xy;
  if (walk.index > line.last || boundsVisibility(walk.depth, rowDepth(line, u), bounds) != current) return false;
  advanceRow(line, walk, next, u);
  return true;
}

// The same integral as segmentLight, over the slice's row. The inner loop finds the next stretch of equal visibility.
Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  int guard = (8 + 4 * GLASS) * (line.last - walk.index + 1) + 16; // bounds the loops whatever the arithmetic does
  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  int unused, unused2;
  bool done = false;
  while (!done) {
    Visibility weight = Visibility(0.0);
    vec2 span = vec2(0.0);
    while (!done && weight == Visibility(0.0)) {
      float state = current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
      float found = walkNodes(line, walk, slice, state, unused, unused2);
      int nodeEnd = ((walk.index >> 4) + 1) << 4;
      bool taking = grid.w > 0 && found == kMixed;
      while (taking) taking = takeGroup(line, walk, slice, state) && walk.index < nodeEnd;
      done = walk.index > line.last || guard <= 0;
      float uTexel = rowEnd(line, walk, walk.index + 1), u = uTexel;
      bool look = !done && walk.index < nodeEnd; // else the next node's turn
      Visibility visibility = current;
      if (look) visibility = found != kMixed ? Visibility(found) : texelVisibility(line, walk, segment, u);
      if (done) visibility = Visibility(0.0);
      if (visibility != current) {
        weight = current;
        span = vec2(from, walk.u);
        current = visibility;
        from = walk.u;
      }
      --guard;
      if (look && found == kMixed) {
        if (u < uTexel) advanceRow(line, walk, walk.index, u);
        else advanceRow(line, walk, walk.index + 1, uTexel);
      }
    }
    sum += Light(weight) * Light(airlight(light, distanceAt(segment, span.x), distanceAt(segment, span.y)));
  }
  return sum;
}
