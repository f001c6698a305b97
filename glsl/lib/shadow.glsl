// Visibility along a camera ray, texel by texel (DESIGN 1, rule 3). A shadow view maps the ray to a straight line in its
// texels and depth, a + s b in homogeneous texel space: along the line the receiver's depth is linear in the line's own
// parameter u, only s needs the rational map.
//
// SHADOW_VIEWS: 0 no shadow map, 1 one view, 2 several. SHADOW_ARRAY, FILTER_BILINEAR, GLASS: 0 or 1.

#if GLASS
#define Visibility vec3 // fraction of the light that passes, per channel
#define Light vec3
#else
#define Visibility float
#define Light Spectrum
#endif

#if SHADOW_VIEWS > 0

#if SHADOW_ARRAY
uniform sampler2DArray shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, ivec3(texel, viewLayer[view].x), 0)
#else
uniform sampler2D shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, texel, 0)
#endif
#if GLASS
#if SHADOW_ARRAY
uniform sampler2DArray glassColour;
uniform sampler2DArray glassDepth;
#else
uniform sampler2D glassColour;
uniform sampler2D glassDepth;
#endif
#endif

// The part of a ray that one view owns: from s0 to s1, in texels and depth from p0 to p1.
struct ViewSegment {
  int view;
  float s0, s1;
  float w0, w1; // homogeneous weights at the ends, > 0
  vec3 p0, p1;
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

// The interval of the ray inside a view's side planes; beforeNear: the part between the light and the near plane,
// else the part from the near plane on. Empty if y <= x.
vec2 viewInterval(int view, Ray ray, float s0, float s1, bool beforeNear) {
  vec4 a = texelFromCamera[view] * vec4(ray.origin, 1.0), b = texelFromCamera[view] * vec4(ray.direction, 0.0);
  vec2 size = vec2(viewCounts.zw);
  clipInterval(a.x, b.x, s0, s1);
  clipInterval(a.y, b.y, s0, s1);
  clipInterval(size.x * a.w - a.x, size.x * b.w - b.x, s0, s1);
  clipInterval(size.y * a.w - a.y, size.y * b.w - b.y, s0, s1);
  float c = a.z - viewDepth[view].x * a.w, d = b.z - viewDepth[view].x * b.w;
  clipInterval(beforeNear ? -c : c, beforeNear ? -d : d, s0, s1);
  if (viewDepth[view].w == 0.0) clipInterval(viewDepth[view].y * a.w - a.z, viewDepth[view].y * b.w - b.z, s0, s1);
  return vec2(s0, s1);
}

ViewSegment viewSegment(int view, Ray ray, float s0, float s1) {
  vec4 a = texelFromCamera[view] * vec4(ray.origin, 1.0), b = texelFromCamera[view] * vec4(ray.direction, 0.0);
  vec4 q0 = a + s0 * b, q1 = a + s1 * b;
  return ViewSegment(view, s0, s1, q0.w, q1.w, q0.xyz / q0.w, q1.xyz / q1.w);
}

// Distance along the camera ray at the line parameter u: u = w1 f / (w0 (1 - f) + w1 f) solved for f = (s - s0)/(s1 - s0).
float distanceAt(ViewSegment segment, float u) {
  float f = u * segment.w0 / (segment.w1 + u * (segment.w0 - segment.w1));
  return u >= 1.0 ? segment.s1 : segment.s0 + (segment.s1 - segment.s0) * f;
}

// Depth stored in a texel, growing away from the light; a texel without a caster never blocks.
float casterDepth(ivec2 texel, int view) {
  float depth = viewDepth[view].z * TEXEL(shadowMap, texel, view).r;
  return depth >= viewDepth[view].y ? 3e38 : depth;
}

#if GLASS
float paneDepth(ivec2 texel, int view) { return viewDepth[view].z * TEXEL(glassDepth, texel, view).r; }
// NaN and negative values count as black, values above 1 as clear.
vec3 paneTint(ivec2 texel, int view) {
  vec3 tint = TEXEL(glassColour, texel, view).rgb;
  return mix(vec3(0.0), min(tint, vec3(1.0)), greaterThanEqual(tint, vec3(0.0)));
}
#endif

#if FILTER_BILINEAR

// Integral over [u0, u1] of a texel centre's bilinear weight (1 - |x|)(1 - |y|) along the line, offsets linear in u:
// a quadratic, for which two Gauss nodes are exact.
float weightIntegral(vec2 offset0, vec2 slope, float u0, float u1) {
  float middle = 0.5 * (u0 + u1), halfLength = 0.5 * (u1 - u0), node = 0.5773502691896257 * halfLength;
  vec2 x = 1.0 - abs(offset0 + slope * (middle - node)), y = 1.0 - abs(offset0 + slope * (middle + node));
  return halfLength * (x.x * x.y + y.x * y.y);
}

// Mean visibility of [u, uEnd] in one cell between four texel centres (2x2 percentage-closer filtering). Each texel's own
// comparison flips where the line crosses its depth: uEnd is cut at the first crossing, so that up to there only the
// bilinear weights vary. p0, slope: the line, texel centres at integers.
Visibility cellVisibility(ivec2 cell, vec3 p0, vec3 slope, int view, float u, inout float uEnd) {
  ivec2 last = viewCounts.zw - 1;
  float inverseDepth = 1.0 / slope.z;
  vec4 depth;
#if GLASS
  vec4 pane;
#endif
  for (int k = 0; k < 4; ++k) {
    ivec2 texel = clamp(cell + ivec2(k & 1, k >> 1), ivec2(0), last);
    depth[k] = casterDepth(texel, view);
    float crossing = (depth[k] - p0.z) * inverseDepth;
    if (crossing > u && crossing < uEnd) uEnd = crossing;
#if GLASS
    pane[k] = paneDepth(texel, view);
    float paneCrossing = (pane[k] - p0.z) * inverseDepth;
    if (paneCrossing > u && paneCrossing < uEnd) uEnd = paneCrossing;
#endif
  }
  float receiver = p0.z + slope.z * (0.5 * (u + uEnd));
  bvec4 lit = greaterThanEqual(depth, vec4(receiver));
  if (!any(lit)) return Visibility(0.0);
#if GLASS
  if (all(lit) && !any(lessThan(pane, vec4(receiver)))) return vec3(1.0);
#else
  if (all(lit)) return 1.0;
#endif
  Visibility sum = Visibility(0.0);
  for (int k = 0; k < 4; ++k) {
    if (!(receiver <= depth[k])) continue;
    ivec2 corner = cell + ivec2(k & 1, k >> 1);
    float weight = weightIntegral(p0.xy - vec2(corner), slope.xy, u, uEnd);
#if GLASS
    sum += receiver > pane[k] ? weight * paneTint(clamp(corner, ivec2(0), last), view) : vec3(weight);
#else
    sum += weight;
#endif
  }
  return sum / max(uEnd - u, 1e-30); // guards a cell of no length, where the sum is 0 too
}

#endif

// Walks the segment cell by cell and integrates the light of each stretch of equal visibility in one go (the delayed
// update of Chen 2011, 3.5). A cell is a texel (nearest), cut where the line crosses a stored depth, or the square
// between four texel centres (bilinear).
Light segmentLight(Airlight light, ViewSegment segment) {
#if FILTER_BILINEAR
  const float kShift = 0.5; // texel centres to integers
  const int kLowest = -1;   // the cell before the first centre
  const int kEventsPerCell = 5 + 4 * GLASS; // a cut at each texel's depth and pane
#else
  const float kShift = 0.0;
  const int kLowest = 0;
  const int kEventsPerCell = 2 + GLASS;
#endif
  int view = segment.view;
  vec3 p0 = vec3(segment.p0.xy - kShift, segment.p0.z), slope = vec3(segment.p1.xy - kShift, segment.p1.z) - p0;
  ivec2 highest = viewCounts.zw - 1;
  ivec2 cell = clamp(ivec2(floor(p0.xy)), ivec2(kLowest), highest);
  ivec2 lastCell = clamp(ivec2(floor(segment.p1.xy - kShift)), ivec2(kLowest), highest);
  ivec2 direction = ivec2(slope.x < 0.0 ? -1 : 1, slope.y < 0.0 ? -1 : 1);
  // Lines of the grid lie at integers; the next one ahead is a cell's high side if the line runs up.
  // A line that does not move along an axis never meets that axis's grid lines.
  vec2 ahead = vec2(max(direction, ivec2(0))) - p0.xy;
  vec2 inverse = vec2(1.0);
  if (slope.x != 0.0) inverse.x = 1.0 / slope.x;
  else ahead.x = 3e38;
  if (slope.y != 0.0) inverse.y = 1.0 / slope.y;
  else ahead.y = 3e38;
  float inverseDepth = 1.0 / slope.z;
  ivec2 cells = abs(lastCell - cell);
  int bound = kEventsPerCell * (cells.x + cells.y + 1);

  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0, u = 0.0;
  for (int i = 0; i <= bound; ++i) {
    bool done = u >= 1.0 || i == bound;
    Visibility visibility = Visibility(0.0);
    float uEnd = u;
    bool cellEnds = true;
    vec2 next = (vec2(cell) + ahead) * inverse;
    if (!done) {
      float uCell = min(min(next.x, next.y), 1.0);
      if (cell == lastCell) uCell = 1.0;
      uEnd = max(u, uCell);
#if FILTER_BILINEAR
      float uCut = uEnd;
      visibility = cellVisibility(cell, p0, slope, view, u, uCut);
      cellEnds = uCut == uEnd;
      uEnd = uCut;
#else
      float depth = casterDepth(cell, view);
      float crossing = (depth - p0.z) * inverseDepth;
      if (crossing > u && crossing < uEnd) { uEnd = crossing; cellEnds = false; }
#if GLASS
      float pane = paneDepth(cell, view);
      float paneCrossing = (pane - p0.z) * inverseDepth;
      if (paneCrossing > u && paneCrossing < uEnd) { uEnd = paneCrossing; cellEnds = false; }
      float middle = p0.z + slope.z * (0.5 * (u + uEnd));
      if (middle <= depth) visibility = middle > pane ? paneTint(cell, view) : vec3(1.0);
#else
      visibility = p0.z + slope.z * (0.5 * (u + uEnd)) <= depth ? 1.0 : 0.0;
#endif
#endif
    }
    if (visibility != current) {
      if (current != Visibility(0.0))
        sum += Light(current) * Light(airlight(light, distanceAt(segment, from), distanceAt(segment, u)));
      current = visibility;
      from = u;
    }
    if (done) break;
    if (cellEnds) {
      if (next.x < next.y) cell.x += direction.x;
      else cell.y += direction.y;
    }
    u = uEnd;
  }
  return sum;
}

#endif

// In-scattered light of [s0, s1] of the ray, shadowed: each view's own part walked, the rest lit or dark.
Light shadowedLight(Airlight light, Ray ray, float s0, float s1) {
  if (!(s1 > s0)) return Light(0.0);
#if SHADOW_VIEWS == 0
  return Light(airlight(light, s0, s1));
#else
#if SHADOW_VIEWS == 1
  const int kViews = 1;
#else
  int kViews = viewCounts.x;
#endif
  bool litOutside = viewCounts.y != 0;
  // Intervals of the views and, where the outside is dark, of the lit parts before their near planes.
  vec2 owned[2 * MAX_SHADOW_VIEWS];
  int count = litOutside ? kViews : 2 * kViews;
  for (int i = 0; i < count; ++i)
    owned[i] = viewInterval(i < kViews ? i : i - kViews, ray, s0, s1, i >= kViews);
  Light sum = Light(0.0);
  float s = s0;
  for (int guard = 0; guard < 4 * MAX_SHADOW_VIEWS + 1 && s < s1; ++guard) {
    int owner = -1;
    float end = s1;
    for (int i = 0; i < count && owner < 0; ++i) {
      if (owned[i].y <= s || owned[i].y <= owned[i].x) continue;
      if (owned[i].x <= s) {
        owner = i;
        end = min(end, owned[i].y);
      } else {
        end = min(end, owned[i].x);
      }
    }
    if (owner >= 0 && owner < kViews) sum += segmentLight(light, viewSegment(owner, ray, s, end));
    else if (owner >= kViews || litOutside) sum += Light(airlight(light, s, end));
    s = end;
  }
  return sum;
#endif
}
