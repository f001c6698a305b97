// How light is integrated through layers that thin out with height, where there is no closed form: piece by piece between the grounds, in
// panels over which densities change by few e-folds and the way of the light by few optical depths. Included by heightSun.glsl, lamp.glsl.

const float kFolds = 1.5;   // of density, over a panel
const float kDepths = 2.0;  // optical depths of a panel
const float kUnseen = 14.0; // e-folds from where a layer is brightest to where it is nothing
const float kDark = 20.0;   // optical depths more than where it is brightest, after which nothing counts,
const float kBlack = 80.0;  // or in all
const int kMostPanels = 160;

float greatestOf(float x) { return x; }
float greatestOf(vec3 x) { return max(x.x, max(x.y, x.z)); }

// Optical depth of the light's way: from a point to the eye, and all of it.
struct Way {
  Spectrum eye, whole;
};

// Where a ray reaches the grounds.
vec2 groundCrossings(Heights heights) {
  bvec2 level = equal(heights.slope, vec2(0.0));
  return mix((groundExponents() - heights.begin) / (heights.slope + vec2(level)), vec2(-1.0), level);
}

// Where along a piece the densities are followed: in steps of kFolds / rate from `first` to `last`.
struct Followed {
  vec2 rate, first, last; // rate: e-folds a unit of length
};

// lightLength: how far light comes through a layer, at a density of 1.
Followed followedOf(Heights heights, float s0, float s1, vec2 lightLength) {
  vec2 ground = groundExponents(), middle = heights.begin + 0.5 * (s0 + s1) * heights.slope;
  vec2 e0 = heights.begin + s0 * heights.slope, e1 = heights.begin + s1 * heights.slope, low = max(min(e0, e1), ground);
  vec2 most = vec2(greatestOf(SPECTRUM(layerExtinction[0])), greatestOf(SPECTRUM(layerExtinction[1])));
  vec2 rate = abs(heights.slope), inverse = 1.0 / max(rate, vec2(1e-30));
  bvec2 counts = greaterThan(most * inverse * exp(-low), vec2(1e-20));
  rate *= vec2(counts) * vec2(greaterThan(middle, ground));
  // The exponent at which the ray, or light on its way to it, has come through one optical depth.
  vec2 eyeDepth = log(max(most * inverse, vec2(1e-30))), lightDepth = log(max(most * lightLength, vec2(1e-30)));
  // Growing along the ray, it is brightest at s1 or that far up; thinning out, at s0 or where light comes down to.
  vec2 growing = s0 + max(e0 - max(low, max(eyeDepth, lightDepth)) - kUnseen, vec2(0.0)) * inverse;
  vec2 thinning = s0 + (kUnseen + max(lightDepth - low, vec2(0.0))) * inverse;
  bvec2 thins = greaterThan(heights.slope, vec2(0.0));
  vec2 last = mix(vec2(s1), thinning, thins);
  return Followed(rate, mix(growing, vec2(s0), thins), mix(vec2(-1.0), last, greaterThan(rate, vec2(0.0))));
}

// The longest step from s on.
float stepFrom(Followed followed, float s) {
  vec2 step = max(followed.first - s, kFolds / max(followed.rate, vec2(1e-30)));
  step = mix(vec2(1e30), step, lessThan(vec2(s), followed.last));
  return min(step.x, step.y);
}

float foldsOver(Followed followed, float s, float len) {
  vec2 within = vec2(lessThan(vec2(s), followed.last)) * vec2(greaterThan(vec2(s + len), followed.first));
  return len * dot(followed.rate, within);
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
