// A walk along the ends of a texel's segments, in order of entries and of exits: at each the transmittance is known exactly. Needs lib/avsm.

struct Walk {
  uint entry, exit; // the next of each
  float from, to;   // depths of those
  float depth, opticalDepth;
  vec2 rate;        // of optical depth, and the rounding it lacks
  int inside;       // segments
  float step;       // at most so far at once
};

float entryOf(uint at) { return at == kTyndallEnd ? 3e38 : segmentAt(at).x; }
float exitOf(uint at) { return at == kTyndallEnd ? 3e38 : segmentAt(at).y; }

Walk startWalk(uint list) {
  uint entry = tyndallLists[list].head, exit = tyndallLists[list].exits;
  return Walk(entry, exit, entryOf(entry), exitOf(exit), -1.0, 0.0, vec2(0.0), 0, 3e38);
}

// Compensated: what enters leaves again, and nothing may be left of it.
void addRate(inout Walk walk, float rate) {
  precise float sum = walk.rate.x + rate;
  precise float back = sum - walk.rate.x;
  precise float lost = (walk.rate.x - (sum - back)) + (rate - back);
  walk.rate = vec2(sum, walk.rate.y + lost);
}

// Goes on to the next node: an end, or a place between where a line is not enough for an exponential. False if nothing is there, though the
// walk may not be over.
bool nextNode(inout Walk walk) {
  float end = min(walk.from, walk.to);
  if (end > walk.depth) {
    float rest = end - walk.depth, parts = ceil(min(rest / walk.step, 64.0));
    float step = parts > 1.0 ? rest / parts : rest;
    if (walk.inside > 0) walk.opticalDepth += (walk.rate.x + walk.rate.y) * step;
    walk.depth = parts > 1.0 ? walk.depth + step : end;
    return true;
  }
  bool jumped = false;
  if (walk.from <= walk.to) {
    vec3 segment = segmentAt(walk.entry);
    float own = opticalDepth(segment.z);
    jumped = segment.y <= segment.x;
    if (jumped) walk.opticalDepth += own;
    else {
      addRate(walk, own / (segment.y - segment.x));
      ++walk.inside;
    }
    walk.entry = tyndallSegments[walk.entry].w;
    walk.from = entryOf(walk.entry);
  } else {
    vec3 segment = segmentAt(walk.exit);
    if (segment.y > segment.x) {
      addRate(walk, -opticalDepth(segment.z) / (segment.y - segment.x));
      if (--walk.inside == 0) walk.rate = vec2(0.0);
    }
    walk.exit = exitLinks[walk.exit];
    walk.to = exitOf(walk.exit);
  }
  float rate = walk.rate.x + walk.rate.y;
  // A quarter of optical depth bends by less than a hundredth; an eighth of the way, where there is very much of it.
  walk.step = rate > 0.0 ? max(0.25 / rate, (min(walk.from, walk.to) - walk.depth) / 8.0) : 3e38;
  return jumped;
}

bool isOver(Walk walk) { return walk.opticalDepth >= kOpaque || (walk.entry == kTyndallEnd && walk.exit == kTyndallEnd); }

vec2 nodeOf(Walk walk) { return vec2(max(walk.depth, 0.0), passedAt(walk.opticalDepth)); }
