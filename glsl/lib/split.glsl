// What a node of a row's tree says of its texels' depths (coded), beyond their bounds: lowest, before, behind, highest.
// No depth lies between `before` and `behind`, so that for a receiver there each texel's visibility is one all along: the
// node's average is their mean and its first moment over the node, from -1 to 1.
// TINT_SUMS (glass, technique lowrank): `before` is behind all panes, `behind` before all casters, if there is such a
// depth: each texel's visibility there is its tint, of which lib/tintSums.glsl has sums; averages are not used.
// GLASS: 0 or 1.

#if GLASS
#define Share vec3 // mean visibility, or a moment of it
#else
#define Share float
#endif

struct Average {
  Share mean, moment;
};

// 1, 1, 0, 0 where depths are stored in 16 bits
#ifdef TINT_SUMS
const vec4 kNoSplit = vec4(3.4e38, -3.4e38, 3.4e38, -3.4e38);
vec4 splitOfBounds(float lowest, float highest) { return vec4(lowest, -3.4e38, 3.4e38, highest); }
#else
const vec4 kNoSplit = vec4(3.4e38, 3.4e38, -3.4e38, -3.4e38);
vec4 splitOfBounds(float lowest, float highest) { return vec4(lowest, lowest, highest, highest); }
#endif

// As textures hold an average: both in one (RG), or one each (RGBA) with glass.
#if GLASS
vec4 storedMean(Average average) { return vec4(average.mean, 0.0); }
vec4 storedMoment(Average average) { return vec4(0.5 * average.moment + 0.5, 0.0); }
Average averageOf(vec4 mean, vec4 moment) { return Average(mean.rgb, 2.0 * moment.rgb - 1.0); }
#else
vec4 storedMean(Average average) { return vec4(average.mean, 0.5 * average.moment + 0.5, 0.0, 0.0); }
Average averageOf(vec4 stored) { return Average(stored.r, 2.0 * stored.g - 1.0); }
#endif

// Where to split: halfway between the bounds; what holds no caster counts as at the far plane.
float splitOf(int view, float lowest, float highest) {
  float far = shadowViews[view].farDepth * rowCodeScale + rowCodeOffset;
  return 0.5 * (lowest + min(highest, max(far, lowest)));
}

// Gathers children 0, 1, ..., count - 1 into a node, begun with its bounds (splitOfBounds) and 0.
void addChild(vec4 child, Average childAverage, int i, int count, float middle, inout vec4 split, inout Average average) {
#ifdef TINT_SUMS
  split.yz = vec2(max(split.y, child.y), min(split.z, child.z));
#else
  Average part = Average(Share(0.0), Share(0.0));
  if (child.x > middle) { // all behind
    split.z = min(split.z, child.x);
    part.mean = Share(child.x <= child.w ? 1.0 : 0.0);
  } else if (child.w <= middle) { // all before
    split.y = max(split.y, child.w);
  } else {
    split.y = max(split.y, child.y);
    split.z = min(split.z, child.z);
    part = childAverage;
  }
  float scale = 1.0 / float(count), place = (2.0 * float(i) + 1.0) * scale - 1.0;
  average.mean += part.mean * scale;
  average.moment += (part.mean * place + part.moment * scale) * scale;
#endif
}
