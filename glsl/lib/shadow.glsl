// Visibility along a camera ray, texel by texel (DESIGN 1, rule 3). A shadow view maps the ray to a straight line in its
// texels and depth, a + s b in homogeneous texel space: along the line the receiver's depth is linear in the line's own
// parameter u, only s needs the rational map.
//
// SHADOW_VIEWS: 0 no shadow map, 1 one view, 2 several. SHADOW_ARRAY, FILTER_BILINEAR, GLASS, CURVES, EYE_CURVES, FOG: 0 or 1.

#define FADES (SHADOW_VIEWS == 2 && LIGHT_KIND == 0) // cascades may fade into one another

#if CURVES || EYE_CURVES
#include "lib/curveNodes.glsl"
#endif
#if SHADOW_VIEWS > 0 || EYE_CURVES
#include "lib/weighted.glsl"
#endif
#if EYE_CURVES
#include "lib/eyeTexels.glsl"
#include "lib/eyeCurves.glsl"
#elif SHADOW_VIEWS > 0
void addSeen(Airlight light, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) { addWeighted(light, s0, s1, mean, moment, sum); }
#endif

// Before any light of a ray is added.
void startSeeing(vec2 position) {
#if EYE_CURVES
  startEyePath(position, cameraRay(position));
#endif
}

// The light of a span that nothing blocks.
void addLit(Airlight light, float s0, float s1, inout Light sum) {
#if EYE_CURVES
  addSeen(light, s0, s1, Visibility(1.0), Visibility(0.0), sum);
#else
  addAirlight(light, s0, s1, Visibility(1.0), sum);
#endif
}

#if SHADOW_VIEWS > 0

#include "lib/shadowMap.glsl"

// The part of a ray that one view owns: from s0 to s1, in texels and depth from p0 to p1.
struct ViewSegment {
  int view;
  float s0, s1;
  float weight; // homogeneous, of the begin over that of the end, > 0
  vec3 p0, p1;
#if FADES
  vec2 share; // of the light at s0 and s1 that the view decides on; linear between
#endif
#if CURVES
  vec2 curveDepth; // linear depth at s0 and s1
#endif
};

// Keeps the part of [s0, s1] where c + s d >= 0.
void clipInterval(float c, float d, inout float s0, inout float s1) {
  if (d == 0.0) {
    if (c < 0.0) s1 = -1.0;
    return;
  }
  float s = -c / d;
  if (d > 0.0) s0 = max(s0, s);
  else s1 = min(s1, s);
}

// The interval of the ray inside a view's side planes, or beyond them by no more than rounding; beforeNear: the part between the
// light and the near plane, else the part from the near plane on. Empty if y <= x.
vec2 viewInterval(int view, Ray ray, float s0, float s1, bool beforeNear) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec2 size = vec2(shadowViews[view].size);
  vec4 margin = shadowViews[view].margin;
  clipInterval(a.x + margin.x, b.x + margin.z, s0, s1);
  clipInterval(a.y + margin.y, b.y + margin.w, s0, s1);
  clipInterval(size.x * a.w - a.x + margin.x, size.x * b.w - b.x + margin.z, s0, s1);
  clipInterval(size.y * a.w - a.y + margin.y, size.y * b.w - b.y + margin.w, s0, s1);
  float c = a.z - shadowViews[view].nearDepth * a.w, d = b.z - shadowViews[view].nearDepth * b.w;
  clipInterval(beforeNear ? -c : c, beforeNear ? -d : d, s0, s1);
  if (shadowViews[view].isOpen == 0) clipInterval(shadowViews[view].farDepth * a.w - a.z, shadowViews[view].farDepth * b.w - b.z, s0, s1);
  return vec2(s0, s1);
}

ViewSegment viewSegment(int view, Ray ray, float s0, float s1, vec2 share) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec4 q0 = a + s0 * b, q1 = a + s1 * b;
  ViewSegment segment;
  segment.view = view;
  segment.s0 = s0;
  segment.s1 = s1;
  segment.weight = q0.w / q1.w;
  segment.p0 = q0.xyz / q0.w;
  segment.p1 = q1.xyz / q1.w;
#if FADES
  segment.share = share;
#endif
#if CURVES
  segment.curveDepth.x = dot(shadowViews[view].curveDepth.xyz, ray.origin + s0 * ray.direction) + shadowViews[view].curveDepth.w;
  segment.curveDepth.y = dot(shadowViews[view].curveDepth.xyz, ray.origin + s1 * ray.direction) + shadowViews[view].curveDepth.w;
#endif
  return segment;
}

// Distance along the camera ray at the line parameter u: u = f / (w (1 - f) + f) solved for f = (s - s0) / (s1 - s0).
float distanceAt(ViewSegment segment, float u) {
  float f = u * segment.weight / (1.0 - u + u * segment.weight);
  return u >= 1.0 ? segment.s1 : segment.s0 + (segment.s1 - segment.s0) * f;
}

#include "lib/spans.glsl"

// A line through the cells of a view's map, from u = 0 to 1. A cell is a texel (nearest) or the square between four texel
// centres (bilinear, coordinates shifted by half a texel so that both kinds have integer corners). Coordinates begin at the view's
// rectangle, cells count from the layer's first.
struct Line {
  vec3 origin, slope; // cell coordinates and depth at u are origin + u slope
  vec2 inverse;       // u per cell; its sign is that of the steps along x and y
  ivec2 last;         // cell
};

// Where on its line a walk from cell to cell stands.
struct Walk {
  ivec2 cell;
  int left;       // cells to walk, this one included
  float u, depth; // and the receiver's depth there
  vec2 ahead;     // the next grid lines, relative to the line's origin
#ifdef SKIPS_NODES
  float stop;     // how far cells are looked at before nodes are again
#endif
};

// The cell at a place of a view, from the one before the first centre on if they are between centres.
ivec2 cellAt(vec2 place, int view) {
  return clamp(ivec2(floor(place)), ivec2(FILTER_BILINEAR == 1 ? -1 : 0), shadowViews[view].size - 1) + firstTexel(view);
}

void startWalk(ViewSegment segment, out Line line, out Walk walk) {
#if FILTER_BILINEAR
  const float kShift = 0.5;
#else
  const float kShift = 0.0;
#endif
#ifdef SKIPS_NODES
  walk.stop = -1.0;
#endif
  line.origin = vec3(segment.p0.xy - kShift, segment.p0.z);
  vec3 end = vec3(segment.p1.xy - kShift, segment.p1.z);
  line.slope = end - line.origin;
  line.last = cellAt(end.xy, segment.view);
  walk.cell = cellAt(line.origin.xy, segment.view);
  ivec2 extent = abs(line.last - walk.cell);
  walk.left = extent.x + extent.y + 1;
  walk.u = 0.0;
  walk.depth = line.origin.z;
  // Along an axis that the line does not move in the next grid line lies at u = 2, which is never reached.
  bvec2 moves = notEqual(extent, ivec2(0));
  ivec2 cell = walk.cell - firstTexel(segment.view);
  walk.ahead = vec2(cell + ivec2(greaterThanEqual(line.slope.xy, vec2(0.0)))) - line.origin.xy;
  walk.ahead = mix(vec2(2.0), walk.ahead, moves);
  line.inverse = mix(vec2(1.0), 1.0 / line.slope.xy, moves);
}

// Where the walk leaves its cell.
float cellEnd(Line line, Walk walk) {
  vec2 next = walk.ahead * line.inverse;
  return walk.left == 1 ? 1.0 : clamp(min(next.x, next.y), walk.u, 1.0);
}

// Into the next cell, across the nearer grid line.
void stepCell(Line line, inout Walk walk, float u, float depth) {
  vec2 next = walk.ahead * line.inverse;
  ivec2 step = next.x < next.y ? ivec2(line.inverse.x < 0.0 ? -1 : 1, 0) : ivec2(0, line.inverse.y < 0.0 ? -1 : 1);
  walk.cell += step;
  walk.ahead += vec2(step);
  walk.u = u;
  walk.depth = depth;
  --walk.left;
}

#ifdef SKIPS_NODES

// On to a later place on the line.
void enterCell(Line line, int view, inout Walk walk, float u) {
  ivec2 cell = ivec2(floor(line.origin.xy + line.slope.xy * u)) + firstTexel(view);
  cell = clamp(cell, min(walk.cell, line.last), max(walk.cell, line.last));
  walk.ahead += vec2(cell - walk.cell);
  walk.cell = cell;
  ivec2 extent = abs(line.last - cell);
  walk.left = u < 1.0 ? extent.x + extent.y + 1 : 0;
  walk.u = u;
  walk.depth = line.origin.z + line.slope.z * u;
}

// Takes all nodes of a tree over the map in which the visibility is `current`, and sets where to look again.
void skipNodes(Line line, int view, Visibility current, inout Walk walk);

#endif

#if FILTER_BILINEAR

// Bilinear weights of a cell's four corners at u, in the order of cornerDepths; of a cell that counts from the view's rectangle.
vec4 cornerWeights(Line line, ivec2 cell, float u) {
  vec2 f = line.origin.xy + line.slope.xy * u - vec2(cell), g = 1.0 - f;
  return vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
}

// The first of four crossings behind u, or `end`.
float firstCrossing(vec4 crossings, float u, float end) {
  vec4 ahead = mix(vec4(end), crossings, greaterThan(crossings, vec4(u)));
  return min(end, min(min(ahead.x, ahead.y), min(ahead.z, ahead.w)));
}

// True if the visibility of a whole cell, entered and left at the given receiver depths, is `current`: all four texels
// lit, before their panes, or all dark.
bool isUnchanged(ivec2 cell, int view, float depthIn, float depthOut, Visibility current) {
  vec4 depth = cornerDepths(cell, view);
  float nearer = min(depthIn, depthOut), farther = max(depthIn, depthOut);
  bool dark = all(lessThan(depth, vec4(nearer)));
  bool lit = all(greaterThanEqual(depth, vec4(farther)));
#if GLASS
  lit = lit && all(greaterThanEqual(cornerPanes(cell, view), vec4(farther)));
#endif
  return lit ? current == Visibility(1.0) : dark && current == Visibility(0.0);
}

// Mean visibility of [u, uEnd] in a cell (2x2 percentage-closer filtering). Each texel's own comparison flips where the
// line crosses its depth or its pane: uEnd is cut at the first crossing, so that up to there only the weights vary.
Visibility pieceVisibility(Line line, ivec2 cell, int view, float u, inout float uEnd) {
  float inverseDepth = 1.0 / line.slope.z;
  vec4 depth = cornerDepths(cell, view);
  uEnd = firstCrossing((depth - line.origin.z) * inverseDepth, u, uEnd);
#if GLASS
  vec4 pane = cornersTinted(cell, view);
  uEnd = firstCrossing((pane - line.origin.z) * inverseDepth, u, uEnd);
#endif
  vec4 receiver = vec4(line.origin.z + line.slope.z * (0.5 * (u + uEnd)));
  bvec4 lit = greaterThanEqual(depth, receiver);
  // The weights are quadratic along the line: two Gauss nodes give their mean exactly.
  float middle = 0.5 * (u + uEnd), node = 0.5773502691896257 * 0.5 * (uEnd - u);
  ivec2 own = cell - firstTexel(view);
  vec4 weights = 0.5 * (cornerWeights(line, own, middle - node) + cornerWeights(line, own, middle + node));
  vec4 litWeights = mix(vec4(0.0), weights, lit);
#if GLASS
  if (all(lit) && !any(lessThan(pane, receiver))) return vec3(1.0);
  vec3 sum = vec3(0.0); // tints are fetched anew: all four would take twelve registers up to here
  for (int i = 0; i < 4; ++i) sum += litWeights[i] * (pane[i] < receiver.x ? cornerTint(cell, i, view) : vec3(1.0));
  return sum;
#else
  return all(lit) ? 1.0 : dot(litWeights, vec4(1.0));
#endif
}

const int kPiecesPerCell = 5 + 4 * GLASS;

#else

bool isUnchanged(ivec2 cell, int view, float depthIn, float depthOut, Visibility current) {
  float depth = casterDepth(cell, view);
  bool litIn = depthIn <= depth, litOut = depthOut <= depth;
#if GLASS
  float pane = paneDepth(cell, view);
  bool behindIn = depthIn > pane, behindOut = depthOut > pane;
  vec3 visibility = litIn ? (behindIn ? paneTint(cell, view) : vec3(1.0)) : vec3(0.0);
  return litIn == litOut && (!litIn || behindIn == behindOut) && visibility == current;
#else
  return litIn == (current != 0.0) && litIn == litOut;
#endif
}

// Visibility of [u, uEnd] in a texel; uEnd is cut where the line crosses the texel's depth or its pane.
Visibility pieceVisibility(Line line, ivec2 cell, int view, float u, inout float uEnd) {
  float inverseDepth = 1.0 / line.slope.z;
  float depth = casterDepth(cell, view);
  float crossing = (depth - line.origin.z) * inverseDepth;
  if (crossing > u && crossing < uEnd) uEnd = crossing;
#if GLASS
  float pane = paneDepth(cell, view);
  crossing = (pane - line.origin.z) * inverseDepth;
  if (crossing > u && crossing < uEnd) uEnd = crossing;
  float receiver = line.origin.z + line.slope.z * (0.5 * (u + uEnd));
  return receiver <= depth ? (receiver > pane ? paneTint(cell, view) : vec3(1.0)) : vec3(0.0);
#else
  return line.origin.z + line.slope.z * (0.5 * (u + uEnd)) <= depth ? 1.0 : 0.0;
#endif
}

const int kPiecesPerCell = 2 + GLASS;

#endif

// Takes the cell if the visibility is `current` all through it.
bool takeCell(Line line, int view, inout Walk walk, Visibility current) {
#ifdef SKIPS_NODES
  if (walk.u >= walk.stop) return false;
#endif
  float u = cellEnd(line, walk);
  float depth = line.origin.z + line.slope.z * u;
  if (walk.left <= 0 || !isUnchanged(walk.cell, view, walk.depth, depth, current)) return false;
  stepCell(line, walk, u, depth);
  return true;
}

// Walks the segment cell by cell and integrates each stretch of equal visibility in one go (the delayed update of Chen
// 2011, 3.5). Three loops, so that lanes that run together do the same thing at the same time: the innermost only asks
// whether a cell changes anything; the middle one looks closely at cells that do; the outer one integrates. Four cells an
// iteration: llvmpipe ends a shader's loops after 65,535 iterations in all.
void addTexels(Airlight light, ViewSegment segment, inout Light sum) {
  int view = segment.view;
  Line line;
  Walk walk;
  startWalk(segment, line, walk);
#if CURVES
  vec2 d = (segment.p1.xy - segment.p0.xy) / vec2(shadowViews[view].size);
  startCurves(segment, abs(d.x) >= abs(d.y), (abs(d.x) >= abs(d.y) ? d.x : d.y) < 0.0, 0);
#endif
  // Bounds the loops whatever the arithmetic does: pieces of cells, changes between them, and one look at nodes every few cells.
  int pieces = (kPiecesPerCell + 2) * walk.left + 8;
#if FILTER_BILINEAR
  int cuts = 600; // that steadiness may ask for: as many more pieces
  pieces += cuts;
#endif
  Visibility current = Visibility(0.0);
  float from = 0.0;
  bool done = false;
  while (!done) {
    Visibility weight;
    float begin, end;
    bool found = false;
    while (!found && !done) {
#ifdef SKIPS_NODES
      if (walk.u >= walk.stop) skipNodes(line, view, current, walk);
#endif
      bool walking = true;
      while (walking) {
        walking = takeCell(line, view, walk, current) && takeCell(line, view, walk, current) &&
                  takeCell(line, view, walk, current) && takeCell(line, view, walk, current);
      }
      done = walk.left <= 0 || pieces <= 0;
#ifdef SKIPS_NODES
      if (!done && walk.u >= walk.stop) {
        --pieces;
        continue;
      }
#endif
      float uCell = cellEnd(line, walk), uEnd = uCell;
#if FILTER_BILINEAR
      // A mean visibility along the line stands for a piece only where the airlight and the line's scale hardly change: whatever is lit,
      // so that a map and its complement add up.
      float s = distanceAt(segment, walk.u), uSteady = 1.0;
      if (!isSteady(light, s, distanceAt(segment, uCell) - s)) {
        uSteady = parameterAt(segment, s + max(steadyLength(light, segment.s0, segment.s1, s), 1e-6 * s));
      }
      float scale = 1.0 - walk.u + walk.u * segment.weight, change = abs(1.0 - segment.weight);
      uSteady = min(uSteady, walk.u + 0.1 * scale / max(change, 0.1 * scale));
#if EYE_CURVES
      uSteady = min(uSteady, parameterAt(segment, s + eyeSteadyLength(s)));
#endif
      if (cuts > 0 && uSteady > walk.u && uSteady < uCell) {
        uEnd = uSteady;
        --cuts;
      }
#endif
      Visibility visibility = Visibility(0.0);
      if (!done) visibility = pieceVisibility(line, walk.cell, view, walk.u, uEnd);
      weight = current;
      begin = from;
      end = walk.u;
      found = visibility != current && current != Visibility(0.0);
      if (visibility != current) from = walk.u;
      current = visibility;
      --pieces;
      float depth = line.origin.z + line.slope.z * uEnd;
      if (uEnd < uCell) {
        walk.u = uEnd;
        walk.depth = depth;
      } else {
        stepCell(line, walk, uEnd, depth);
      }
    }
    if (!found) break;
#if !FILTER_BILINEAR && !GLASS
    weight = 1.0; // lit or dark
#endif
#if FADES || CURVES || EYE_CURVES
    addSpan(light, segment, begin, end, weight, Visibility(0.0), sum);
#else
    addAirlight(light, distanceAt(segment, begin), distanceAt(segment, end), weight, sum);
#endif
  }
}

#endif

#include "lib/views.glsl"
