// Runs of changed strips of kWidth lines, of up to kRun strips: one rectangle is drawn for each, since the pixels along the diagonal
// between a rectangle's two triangles are shaded twice. Needs kWidth and bool isDrawn(strip).

const int kRun = 8;

// The run that begins at a strip, from and to; nothing if none does.
ivec2 runFrom(int strip, int strips) {
  if (!isDrawn(strip) || ((strip & (kRun - 1)) != 0 && isDrawn(strip - 1))) return ivec2(strip);
  int end = strip + 1;
  while (end < strips && (end & (kRun - 1)) != 0 && isDrawn(end)) ++end;
  return ivec2(strip, end);
}
