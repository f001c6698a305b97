// Between two slices a ray walks its own line through the shadow map, cell by cell as exact.frag does (lib/shadow.glsl),
// but takes whole nodes where the rows of both slices agree (pairTree.frag, in place of rowTree).

#if SHADOW_VIEWS > 0

RowLine trueRow; // of the slice on one side of the ray

// As walkNodes of lib/tree.glsl, but from groups of four texels on, and from anywhere in one: its bounds hold for every
// part of it.
void skipNodes(Line line, int view, Visibility current, inout Walk walk) {
  walk.stop = 2.0;
  if (treeLevels == 0) return;
  float state = current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
  float extent = trueRow.inverse > 0.0 ? 1.0 / trueRow.inverse : 0.0;
  RowWalk at = RowWalk(clamp(int(floor(trueRow.begin + walk.u * extent)), 0, trueRow.last), walk.u);
  int level = 1, base = 0;
  bool walking = walk.left > 0;
  while (walking) {
    int node = at.index >> (2 * level), next = (node + 1) << (2 * level);
    float u = rowEnd(trueRow, at, next);
    float found = boundsVisibility(rowDepth(trueRow, at.u), rowDepth(trueRow, u), texelFetch(rowTree, ivec2(base + node, trueRow.row), 0).rg);
    if (found == state) {
      at = RowWalk(next, u);
      bool up = level < treeLevels && (next & ((4 << (2 * level)) - 1)) == 0;
      base += up ? rowLength >> (2 * level) : 0;
      level += up ? 1 : 0;
      walking = at.index <= trueRow.last;
    } else {
      walking = found == kMixed && level > 1;
      --level;
      base -= walking ? rowLength >> (2 * level) : 0;
    }
  }
  if (at.u > walk.u) enterCell(line, view, walk, at.u);
  int end = ((at.index >> 2) + 1) << 2;
  walk.stop = rowEnd(trueRow, at, end);
  if (walk.stop <= walk.u) walk.stop = rowEnd(trueRow, at, end + 4); // rounding left the walk a step behind
  if (walk.stop >= 1.0) walk.stop = 2.0; // the line's last cells, however they round
}

void addOwned(Airlight light, ViewSegment segment, int slice, inout Light sum) {
  RowWalk unused;
  startRow(light, segment, slice, trueRow, unused);
  addTexels(light, segment, sum);
}

#endif
