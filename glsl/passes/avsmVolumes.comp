// AVSM volumes: fog and smoke of a density that a grid holds, or that is even, along the ray of each texel that a volume covers: as segments of
// even media that follow its optical depth, each exact between its ends. Empty bricks of a grid are stepped over (avsmRanges.comp); elsewhere
// steps end where cells between texels' centres do, with two Gauss nodes each: exact for the cubic that a trilinear density is along a ray in one.
// Reads the grid's density (R8, R16, R16F, R32F) and ranges (RG32F). Writes into the captured lists or, STREAMED 1, inserts into the curves.
#include "lib/avsmSegment.glsl"
#include "lib/avsmRay.glsl"
#include "lib/avsmDensity.glsl"
#if STREAMED
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#define CURVES_ACCESS
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"
#else
#include "public/avsmCapture.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform VolumeBlock {
  View view;               // relative to the volume's centre
  vec4 volumeFromWorld[3]; // rows: to where the volume is the cube, or the unit sphere, from -1 to 1
  ivec4 texels;            // that may see it: from xy on, up to zw
  ivec4 gridSize;          // texels of the density; x 0: it has none. w: levels of its ranges
  ivec4 brickCount;        // of the finest level; w: layer of the map
  vec4 shape;              // x: 1 of a sphere, 0 of a box; y: share of half its extent over which it fades in from its border; z: extinction where density is 1
};
layout(binding = 0) uniform sampler3D density;
layout(binding = 1) uniform sampler3D ranges; // least and most that is read within a brick of 4 x 4 x 4 texels, and within 2 x 2 x 2 of those, ...

const int kBrick = 4;
const float kTolerance = 1e-3; // of the transmittance: what a segment's may be off by within it
const float kOpaque = 16.0;    // optical depth from which on nothing passes,
const float kMostDepth = 1e4;  // and more than which no step has
const float kLongest = 2.0;    // of a segment: of a longer one curves tell too little
const float kFadeSteps = 12.0; // over a fade, at least,
const float kMostSteps = 2048.0; // and over all of a volume, if those were more
const float kGauss = 0.28867513459481287; // of two nodes, from the middle, in steps

ivec3 texel;
vec3 start, along;       // the texel's ray in the volume's coordinates, by depth from where it enters
float entered;           // depth there
float extinctionOfDepth; // where density is 1, a unit of depth

// The segment under way: from one depth to another an optical depth, and the slopes from its begin that come near enough to what it
// has been at the ends of steps.
float from, to, opticalDepth, leastSlope, mostSlope;
float before; // optical depth of all segments so far

void endSegment() {
  float passed = exp(-min(opticalDepth, 80.0));
  if (opticalDepth > 0.0) {
#if STREAMED
    vec3 segment;
    if (tyndallSegment(entered + from, entered + to, passed, segment)) tyndallInsertSegment(segment);
#else
    tyndallCapture(texel, entered + from, entered + to, passed);
#endif
  }
  before += opticalDepth;
  opticalDepth = 0.0;
  from = to;
  leastSlope = 0.0;
  mostSlope = 1e37;
}

// A step up to a depth, or to where nothing passes any more: a segment is as even as its medium only while that can be told.
void addStep(float end, float own) {
  float left = kOpaque + 0.5 - before - opticalDepth;
  if (own > left) {
    end = to + (end - to) * (left / own);
    own = left;
  }
  float sum = opticalDepth + own, len = max(end - from, 1e-9), slope = sum / len;
  if (opticalDepth > 0.0 && (slope < leastSlope || slope > mostSlope || sum > kLongest)) {
    endSegment();
    sum = own;
    len = max(end - from, 1e-9);
  }
  float tolerance = kTolerance * exp(min(before + sum, kOpaque));
  leastSlope = max(leastSlope, (sum - tolerance) / len);
  mostSlope = min(mostSlope, (sum + tolerance) / len);
  opticalDepth = sum;
  to = end;
  if (sum == 0.0) {
    from = end;
    mostSlope = 1e37;
  }
}

float texelDensity(ivec3 at) { return cleanedDensity(texelFetch(density, at, 0).r); }

// Texels at the corners of a cell, and where it begins; of a grid all whose texels are 1 where there is none.
struct Cell {
  vec3 low;
  vec4 near, far;
} cell;

// Along the ray, in texels, where their centres are whole numbers.
vec3 gridStart, gridAlong;

void enterCell(float s) {
  cell = Cell(floor(gridStart + s * gridAlong), vec4(1.0), vec4(1.0));
  if (gridSize.x == 0) return;
  ivec3 last = gridSize.xyz - 1, a = clamp(ivec3(cell.low), ivec3(0), last), b = clamp(ivec3(cell.low) + 1, ivec3(0), last);
  cell.near = vec4(texelDensity(a), texelDensity(ivec3(b.x, a.yz)), texelDensity(ivec3(a.x, b.y, a.z)), texelDensity(ivec3(b.xy, a.z)));
  cell.far = vec4(texelDensity(ivec3(a.xy, b.z)), texelDensity(ivec3(b.x, a.y, b.z)), texelDensity(ivec3(a.x, b.yz)), texelDensity(b));
}

// In the cell: trilinear, all of it, since samplers round the weights.
float densityAt(float s) {
  vec3 f = gridStart + s * gridAlong - cell.low;
  vec4 layer = mix(cell.near, cell.far, f.z);
  vec2 row = mix(layer.xy, layer.zw, f.y);
  float value = max(mix(row.x, row.y, f.x), 0.0);
  if (shape.y > 0.0) {
    vec3 x = start + s * along, t = clamp((1.0 - (shape.x > 0.0 ? vec3(length(x)) : abs(x))) / shape.y, 0.0, 1.0);
    t *= t * (3.0 - 2.0 * t);
    value *= shape.x > 0.0 ? t.x : t.x * t.y * t.z;
  }
  return value;
}

const float kNudge = 1e-3; // of a cell: what rounding may leave of one

// The ray's length in a cell, where it runs along its longest axis.
float longestStep() { return 1.0 / max(max(abs(gridAlong.x), max(abs(gridAlong.y), abs(gridAlong.z))), 1e-30); }

// Where a line of start and slope reaches bounds, by axis; never along an axis that it does not move in.
float firstOf(vec3 bounds) {
  bvec3 still = equal(gridAlong, vec3(0.0));
  vec3 exits = mix((bounds - gridStart) / mix(gridAlong, vec3(1.0), still), vec3(1e37), still);
  return min(exits.x, min(exits.y, exits.z));
}

// Where the step from s on ends: with its cell, or where the fade asks for it.
float stepEnd(float s, float end, float longest, float fadeStep) {
  float next = s + fadeStep;
  if (gridSize.x > 0) {
    vec3 at = gridStart + s * gridAlong;
    next = min(next, max(firstOf(mix(ceil(at - kNudge) - 1.0, floor(at + kNudge) + 1.0, greaterThan(gridAlong, vec3(0.0)))), s + kNudge * longest));
  }
  return next < end ? next : end;
}

// In how many parts a step of the cell is taken, so that optical depth is a line within each: where density changes by d over a length, it is off
// that by an eighth of d times the length.
int partsOf(float len) {
  vec4 high = max(cell.near, cell.far), low = min(cell.near, cell.far);
  float most = max(max(high.x, high.y), max(high.z, high.w)), least = min(min(low.x, low.y), min(low.z, low.w));
  float change = most - least + (shape.y > 0.0 ? 0.15 * most : 0.0), off = 0.125 * change * extinctionOfDepth * len;
  return int(clamp(ceil(sqrt(off / (kTolerance * exp(before + opticalDepth)))), 1.0, 32.0));
}

// A stretch from s on: up to where, and its density if that is even, else -1. fades: it lies where the volume fades in.
vec2 nextStretch(float s, float end, float longest, bool fades) {
  if (gridSize.x == 0) return vec2(end, fades ? -1.0 : 1.0);
  // Behind the border where the last one ended, by what rounding may leave, along each axis by itself.
  vec3 inside = gridStart + s * gridAlong + kNudge * sign(gridAlong);
  ivec3 brick = clamp(ivec3(floor((inside + 0.5) / float(kBrick))), ivec3(0), brickCount.xyz - 1);
  float even = -1.0;
  int level = gridSize.w;
  while (level > 0 && even < 0.0) {
    --level;
    vec2 range = texelFetch(ranges, brick >> level, level).rg;
    if (range.x == range.y && (range.y == 0.0 || !fades)) even = range.y;
  }
  vec3 low = vec3((brick >> level) << level) * float(kBrick), high = low + float(kBrick << level);
  float exit = firstOf(mix(low, high, greaterThan(gridAlong, vec3(0.0))) - 0.5);
  return vec2(min(max(exit, s + kNudge * longest), end), even);
}

// Where a ray is in the box or the sphere of a size; empty if y <= x.
vec2 interval(float size) {
  if (shape.x > 0.0) {
    float square = dot(along, along), middle = -dot(start, along) / max(square, 1e-37);
    vec3 beside = start + middle * along;
    float halfChord = sqrt(max(size * size - dot(beside, beside), 0.0) / max(square, 1e-37));
    return vec2(middle - halfChord, middle + halfChord);
  }
  bvec3 still = equal(along, vec3(0.0));
  vec3 inverse = 1.0 / mix(along, vec3(1.0), still);
  vec3 a = (-size - start) * inverse, b = (size - start) * inverse;
  bvec3 outside = greaterThan(abs(start), vec3(size));
  vec3 low = mix(min(a, b), mix(vec3(-1e37), vec3(1e37), outside), still), high = mix(max(a, b), vec3(1e37), still);
  return vec2(max(low.x, max(low.y, low.z)), min(high.x, min(high.y, high.z)));
}

// From where the ray enters, up to a depth from there. nearPlane: where the map begins; what lies before it dims light there.
void march(float end, float nearPlane) {
  float longest = longestStep(), fadeStep = shape.y > 0.0 ? shape.y / (kFadeSteps * max(max(abs(along.x), max(abs(along.y), abs(along.z))), 1e-30)) : 1e37;
  fadeStep = max(fadeStep, end / kMostSteps);
  vec2 even = shape.y > 0.0 ? interval(1.0 - shape.y) : vec2(0.0, end); // where nothing fades
  if (!(even.y > even.x)) even = vec2(end);
  from = to = 0.0;
  opticalDepth = before = leastSlope = 0.0;
  mostSlope = 1e37;
  float s = 0.0;
  while (s < end && before + opticalDepth < kOpaque) {
    float first = s;
    bool fades = s < even.x || s >= even.y;
    float most = s < even.x ? min(even.x, end) : s < even.y ? min(even.y, end) : end;
    if (s < nearPlane) most = min(most, nearPlane);
    vec2 stretch = nextStretch(s, most, longest, fades);
    if (stretch.y == 0.0) {
      endSegment();
      from = to = stretch.x;
    } else if (stretch.y > 0.0) {
      float own = min(stretch.y * extinctionOfDepth * (stretch.x - s), kMostDepth), seen = min(own, kOpaque + 0.5);
      float len = (stretch.x - s) * (own > 0.0 ? seen / own : 1.0), parts = max(ceil(seen / kLongest), 1.0);
      for (float i = 1.0; i < parts; ++i) addStep(s + len * (i / parts), seen / parts);
      addStep(seen < own ? s + len : stretch.x, seen / parts);
    } else {
      while (s < stretch.x) {
        float next = stepEnd(s, stretch.x, longest, fades ? fadeStep : 1e37);
        enterCell(0.5 * (s + next));
        int parts = partsOf(next - s);
        float own = (next - s) / float(parts), middle = s + 0.5 * own;
        for (int i = 0; i < parts; ++i) {
          float mean = 0.5 * (densityAt(middle - kGauss * own) + densityAt(middle + kGauss * own));
          addStep(i + 1 < parts ? middle + 0.5 * own : next, min(mean * extinctionOfDepth * own, kMostDepth));
          middle += own;
        }
        s = next > s ? next : stretch.x;
      }
    }
    if (first < nearPlane && stretch.x >= nearPlane) endSegment();
    s = stretch.x > first ? stretch.x : end;
  }
  endSegment();
}

void main() {
  texel = ivec3(texels.xy + ivec2(gl_GlobalInvocationID.xy), brickCount.w);
  if (any(greaterThanEqual(texel.xy, texels.zw))) return;
  Ray ray = rayOf(view, vec2(texel.xy) + 0.5);
  for (int i = 0; i < 3; ++i) {
    start[i] = dot(volumeFromWorld[i].xyz, ray.start);
    along[i] = dot(volumeFromWorld[i].xyz, ray.along);
  }
  vec2 inside = interval(1.0);
  inside = vec2(max(inside.x, ray.behindLight), min(inside.y, 1.0));
  if (!(inside.y > inside.x)) return;
  entered = inside.x;
  start += entered * along;
  extinctionOfDepth = shape.z * length(ray.along);
  gridStart = (0.5 * start + 0.5) * vec3(gridSize.xyz) - 0.5;
  gridAlong = 0.5 * along * vec3(gridSize.xyz);
#if STREAMED
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, imageLoad(curveImage, placeOf(texel, i)));
  tyndallFindUsed();
#endif
  march(inside.y - inside.x, -inside.x);
#if STREAMED
  tyndallPadCurve();
  storeCurve(texel);
#endif
}
