// How light is integrated through layers that thin out with height, where there is no closed form: piece by piece between the grounds, in
// panels over which densities change by few e-folds and the way of the light by few optical depths. Included by airlight.glsl.

const float kFolds = 2.0;   // of density, over a panel
const float kDepths = 2.0;  // optical depths of a panel
const float kUnseen = 14.0; // e-folds from where a layer is brightest to where it is nothing
const float kDark = 20.0;   // optical depths more than where it is brightest, after which nothing counts,
const float kBlack = 80.0;  // or in all
const float kEndless = 1e30; // optical depths, more than which are none: floats end there
const int kMostPanels = 160;

float greatestOf(float x) { return x; }
float greatestOf(vec3 x) { return max(x.x, max(x.y, x.z)); }

Layers mostExtinction() { return LAYERS(greatestOf(SPECTRUM(layerExtinction[0])), greatestOf(SPECTRUM(layerExtinction[1]))); }

// 1 above the ground, where densities change, else 0.
Layers aboveGround(Layers exponents) { return moreThan(exponents, groundExponents(), Layers(1.0), Layers(0.0)); }

// Optical depth of the light's way: from a point to the eye, and all of it.
struct Way {
  Spectrum eye, whole;
};

// Where a ray reaches the grounds; -1 if it does not.
Layers groundCrossings(Heights heights) {
  Layers slope = abs(heights.slope), crossing = (groundExponents() - heights.begin) / max(slope, 1e-37);
  return moreThan(slope, Layers(0.0), crossing * sign(heights.slope), Layers(-1.0));
}

// The end of a piece from s on: s1, or a ground before it.
float pieceEnd(Layers crossings, float s, float s1) { return min(s1, leastOf(moreThan(crossings, Layers(s), crossings, Layers(s1)))); }

// Where along a piece the densities are followed: in steps of kFolds / rate from `first` to `last`.
struct Followed {
  Layers rate, first, last; // rate: e-folds a unit of length
};

// lightLength: how far light comes through a layer, at a density of 1.
Followed followedOf(Heights heights, Layers s0, Layers s1, Layers lightLength) {
  Layers e0 = heights.begin + s0 * heights.slope, e1 = heights.begin + s1 * heights.slope, low = max(min(e0, e1), groundExponents());
  Layers most = mostExtinction(), rate = abs(heights.slope), inverse = 1.0 / max(rate, 1e-30);
  rate *= aboveGround(0.5 * (e0 + e1)) * moreThan(most * inverse * exp(-low), Layers(1e-20), Layers(1.0), Layers(0.0));
  // The exponent at which the ray, or light on its way to it, has come through one optical depth.
  Layers eyeDepth = log(max(most * inverse, 1e-30)), lightDepth = log(max(most * lightLength, 1e-30));
  // Growing along the ray, it is brightest at s1 or that far up; thinning out, at s0 or where light comes down to.
  Layers growing = s0 + max(e0 - max(low, max(eyeDepth, lightDepth)) - kUnseen, 0.0) * inverse;
  Layers thinning = s0 + (kUnseen + max(lightDepth - low, 0.0)) * inverse;
  Layers first = moreThan(heights.slope, Layers(0.0), s0, growing), last = moreThan(heights.slope, Layers(0.0), thinning, s1);
  return Followed(rate, first, moreThan(rate, Layers(0.0), last, Layers(-1.0)));
}

// The longest step from s on.
float stepFrom(Followed followed, float s) {
  Layers len = max(followed.first - s, kFolds / max(followed.rate, 1e-30));
  return leastOf(moreThan(followed.last, Layers(s), len, Layers(1e30)));
}

float foldsOver(Followed followed, float s, float len) {
  Layers begun = moreThan(Layers(s + len), followed.first, followed.rate, Layers(0.0));
  return len * sumOf(moreThan(followed.last, Layers(s), begun, Layers(0.0)));
}

// The same for the pieces of [s0, s1] that s lies in.
Followed followedAt(Heights heights, float s0, float s1, float s, Layers lightLength) {
  Layers crossings = groundCrossings(heights), begin = Layers(s0), end = Layers(s1);
  begin = moreThan(crossings, Layers(s), begin, max(crossings, begin));
  end = moreThan(crossings, Layers(s), min(crossings, end), end);
  return followedOf(heights, begin, end, lightLength);
}

// A length from s on over which light changes by about a twentieth in the channel that needs most care, but more where less is left: where the
// way is longer than the shortest or, which tells of twenty depths on, long in all. taken: how many depths a unit of length it grows by or,
// towards where it is shortest, falls.
float steadyLength(Heights heights, Followed followed, float s, Spectrum way, Spectrum shortest, Spectrum taken) {
  Spectrum gone = max(max(way - shortest, 0.5 * way - 10.0), Spectrum(0.0));
  Layers ahead = followed.first - s, begun = moreThan(ahead, Layers(0.0), Layers(0.0), followed.rate);
  float folds = sumOf(moreThan(followed.last, Layers(s), begun, Layers(0.0)));
  Spectrum len = 0.05 * exp(0.25 * min(gone, Spectrum(240.0))) / max(taken + folds, Spectrum(1e-30));
  len = min(len, (0.05 + 0.25 * gone) / max(taken, Spectrum(1e-30)));
  float toBegin = leastOf(moreThan(min(ahead, followed.last - s), Layers(0.0), ahead, Layers(1e30)));
  return min(min(-greatestOf(-len), 1.0 / max(folds, 1e-30)), min(toBegin, pieceEnd(groundCrossings(heights), s, 1e30) - s));
}

// 1 for channels in which light from there on still counts, where the least that the whole way was is known, else 0. (The way to the eye
// only grows; that from the light may become less.)
Spectrum aliveAt(Way way, Spectrum least) { return Spectrum(1.0) - step(Spectrum(kDark), max(way.eye - least, 0.25 * way.eye)); }

// By how many optical depths the whole way changes, in channels where that is seen: of a way that grows, unless it is kDark more than it was
// at least; of one that becomes less, from kDark more than what it becomes.
float changeOf(Spectrum alive, Spectrum least, Way from, Way to) {
  Spectrum grows = step(from.whole, to.whole) * (Spectrum(1.0) - step(least + kDark, from.whole));
  Spectrum less = max(min(from.whole, min(to.whole + kDark, Spectrum(kBlack))) - to.whole, Spectrum(0.0));
  return min(greatestOf(alive * (grows * min(abs(to.whole - from.whole), Spectrum(1e30)) + less)), 1e30);
}

// True if from here to the middle of a step all is dark beside what is at its end.
bool isDarkBefore(Spectrum alive, Way from, Way middle, Way to) {
  Spectrum bright = alive * (Spectrum(1.0) - step(to.whole + kDark, min(from.whole, middle.whole)));
  return greatestOf(bright) == 0.0;
}
