// A walk along the ends of a texel's segments, in order of entries and of exits: at each the transmittance is known exactly. All that differs
// between an entry and an exit is selected, not branched for, so that neighbouring texels go in step. Needs lib/avsm.

struct End {
  uint at, next; // segment, and the next of the order
  float depth;
  float rate;    // of optical depth per depth, of a segment that has a length
  float jump;    // optical depth of one that has none
};

struct Walk {
  End entry, exit;
  float depth, opticalDepth;
  vec2 rate;  // of optical depth, and the rounding it lacks
  int inside; // segments
  float step; // at most so far at once
};

const float kNoEnd = 3e38;

End endAt(uint at, bool isExit) {
  if (at == kTyndallEnd) return End(at, at, kNoEnd, 0.0, 0.0);
  uvec4 segment = tyndallSegments[at];
  float entry = uintBitsToFloat(segment.x), exit = uintBitsToFloat(segment.y), own = opticalDepth(uintBitsToFloat(segment.z));
  uint next = isExit ? exitLinks[at] : segment.w;
  return End(at, next, isExit ? exit : entry, exit > entry ? own / (exit - entry) : 0.0, exit > entry ? 0.0 : own);
}

// Compensated: what enters leaves again, and nothing may be left of it.
void addRate(inout Walk walk, float rate) {
  precise float sum = walk.rate.x + rate;
  precise float back = sum - walk.rate.x;
  precise float lost = (walk.rate.x - (sum - back)) + (rate - back);
  walk.rate = vec2(sum, walk.rate.y + lost);
}

// At the first entry, of a list that is not empty.
Walk startWalk(uint list) {
  End entry = endAt(tyndallLists[list].head, false), exit = endAt(tyndallLists[list].exits, true);
  return Walk(entry, exit, entry.depth, 0.0, vec2(0.0), 0, 0.0);
}

// Past the end where the walk stands.
void passEnd(inout Walk walk) {
  bool isExit = walk.exit.depth < walk.entry.depth;
  float rate = isExit ? walk.exit.rate : walk.entry.rate;
  addRate(walk, isExit ? -rate : rate);
  walk.opticalDepth += isExit ? 0.0 : walk.entry.jump;
  walk.inside += rate > 0.0 ? (isExit ? -1 : 1) : 0;
  walk.rate = walk.inside == 0 ? vec2(0.0) : walk.rate;
  End next = endAt(isExit ? walk.exit.next : walk.entry.next, isExit);
  if (isExit) walk.exit = next;
  else walk.entry = next;
  // A quarter of optical depth bends by less than a hundredth; an eighth of the way, where there is very much of it.
  float sum = walk.rate.x + walk.rate.y;
  walk.step = sum > 0.0 ? max(0.25 / sum, (min(walk.entry.depth, walk.exit.depth) - walk.depth) / 8.0) : kNoEnd;
}

// Goes on to the next node: an end, or a place between where a line is not enough for an exponential. False at the last one, or where nothing
// passes any more.
bool nextNode(inout Walk walk) {
  if (walk.depth >= min(walk.entry.depth, walk.exit.depth)) passEnd(walk);
  float end = min(walk.entry.depth, walk.exit.depth);
  if (end >= kNoEnd) return false;
  float rest = end - walk.depth, parts = ceil(min(rest / walk.step, 64.0)), step = parts > 1.0 ? rest / parts : rest;
  walk.opticalDepth += (walk.rate.x + walk.rate.y) * step;
  walk.depth = parts > 1.0 ? walk.depth + step : end;
  return true;
}

bool isOver(Walk walk) { return walk.opticalDepth >= kOpaque; }

vec2 nodeOf(Walk walk) { return vec2(walk.depth, passedAt(walk.opticalDepth)); }
