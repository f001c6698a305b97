// Which shadow view a stretch of a camera ray belongs to, and how cascades fade into one another. Included by shadow.glsl.

// What a view's own segment contributes: texel by texel (addTexels), or along a slice's row (addRow).
#if SHADOW_VIEWS > 0
void addOwned(Airlight light, ViewSegment segment, int slice, inout Light sum);
#endif

#ifndef FADE_STEPS
#define FADE_STEPS 1
#endif
// Parts of a ray that views own, and those between the light and their near planes.
const int kMostViews = SHADOW_VIEWS == 2 ? MAX_SHADOW_VIEWS : 1, kMostOwned = 2 * kMostViews;

const int kFadeSteps = SHADOW_VIEWS == 2 ? FADE_STEPS : 1; // pieces of a fade, over each of which the weight is a line
const int kCornerSteps = 4 * kFadeSteps; // where the weight comes and goes without having been 1
const int kMostPieces = (4 + kCornerSteps) * kFadeSteps * kMostViews;

#if FADES

// The part of [s0, s1] where a view has all the weight, away from its sides by its fade and, unless it is open there, from
// its far plane. Empty if y <= x.
vec2 wholeInterval(int view, Ray ray, float s0, float s1) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec2 size = vec2(shadowViews[view].size), inset = cascadeFade * size, end = size - inset;
  clipInterval(a.x - inset.x * a.w, b.x - inset.x * b.w, s0, s1);
  clipInterval(a.y - inset.y * a.w, b.y - inset.y * b.w, s0, s1);
  clipInterval(end.x * a.w - a.x, end.x * b.w - b.x, s0, s1);
  clipInterval(end.y * a.w - a.y, end.y * b.w - b.y, s0, s1);
  float far = mix(shadowViews[view].farDepth, shadowViews[view].nearDepth, cascadeFade);
  if (shadowViews[view].isOpen == 0) clipInterval(far * a.w - a.z, far * b.w - b.z, s0, s1);
  return vec2(s0, s1);
}

// A view's weight at s: its distance to its nearest side, or to its far plane, over its fade.
float viewWeight(int view, Ray ray, float s) {
  vec4 q = shadowViews[view].texelFromCamera * vec4(ray.origin + s * ray.direction, 1.0);
  vec2 place = q.xy / (q.w * vec2(shadowViews[view].size)), side = min(place, 1.0 - place);
  float least = min(side.x, side.y), far = shadowViews[view].farDepth;
  if (shadowViews[view].isOpen == 0) least = min(least, (far - q.z / q.w) / (far - shadowViews[view].nearDepth));
  return clamp(least / cascadeFade, 0.0, 1.0);
}

// Where a view that owns [s, end] fades, the next view that reaches there has the rest of the weight: returns that one, or
// -1, and cuts `end` so that the owner's weights at the ends of the piece stand for all of it.
int fadeInto(int owner, Ray ray, float s0, float s1, float s, inout float end, out vec2 weight) {
  int next = -1;
  weight = vec2(1.0);
  for (int i = owner + 1; i < viewCount && next < 0; ++i) {
    vec2 own = viewInterval(i, ray, s, s1, false);
    if (own.y <= own.x) continue;
    if (own.x <= s) next = i;
    end = min(end, own.x <= s ? own.y : own.x);
  }
  if (next < 0) return -1;
  vec2 own = viewInterval(owner, ray, s0, s1, false), whole = wholeInterval(owner, ray, s0, s1);
  bool hasWhole = whole.y > whole.x, before = hasWhole && s < whole.x, behind = hasWhole && s >= whole.y;
  if (hasWhole && !before && !behind) {
    end = min(end, whole.y);
    return -1;
  }
  float first = behind ? whole.y : own.x, last = before ? whole.x : own.y;
  end = min(min(end, last), s + max((last - first) / float(hasWhole ? kFadeSteps : kCornerSteps), 1e-6 * abs(s)));
  weight = vec2(viewWeight(owner, ray, s), viewWeight(owner, ray, end));
  return next;
}

#endif

// In-scattered light of [s0, s1] of the ray through a window position, shadowed: each view's own part walked, the rest lit or dark. Of
// the views just `views.y` from view `views.x` on; outside: what is in no view, too. The slice is for addOwned. What of the ray a walk
// does not need is made anew behind it, where it is needed again: so no registers hold it meanwhile.
#if SHADOW_VIEWS == 0

Light shadowedLight(vec2 position, float s0, float s1, ivec2 views, bool outside, int slice) {
  Light sum = Light(0.0);
  startSeeing(position);
  Airlight light = airlightOf(cameraRay(position));
  litRange(light, s0, s1);
  addLit(light, s0, s1, sum);
  return sum;
}

#elif SHADOW_VIEWS == 1

Light shadowedLight(vec2 position, float s0, float s1, ivec2 views, bool outside, int slice) {
  Light sum = Light(0.0);
  if (s1 > s0) {
    Ray ray = cameraRay(position);
    startSeeing(position);
    Airlight light = airlightOf(ray);
    litRange(light, s0, s1);
    vec2 own = viewInterval(0, ray, s0, s1, false);
    if (!(own.y > own.x)) own = vec2(max(s0, s1));
    // What is lit without a look at the map: before and behind the view or, where the outside is dark, before the near plane.
    vec2 before = isLitOutside != 0 ? vec2(s0, own.x) : viewInterval(0, ray, s0, s1, true);
    vec2 behind = isLitOutside != 0 ? vec2(own.y, s1) : vec2(0.0);
    for (int k = 0; k < 2; ++k) {
      vec2 span = k == 0 ? before : behind;
      if (outside) addLit(light, span.x, span.y, sum);
    }
    if (own.y > own.x) addOwned(light, viewSegment(0, ray, own.x, own.y, vec2(1.0)), slice, sum);
  }
  return sum;
}

#else

// The part of the ray that a view has or, beyond the views, that one has between the light and its near plane.
vec2 ownInterval(int owner, Ray ray, float s0, float s1) {
  bool beforeNear = owner >= viewCount;
  return viewInterval(beforeNear ? owner - viewCount : owner, ray, s0, s1, beforeNear);
}

Light shadowedLight(vec2 position, float s0, float s1, ivec2 views, bool outside, int slice) {
  Light sum = Light(0.0);
  startSeeing(position);
  float s = s0;
  int turn = 0; // of the two views that share a fade
  for (int guard = 0; guard < kMostPieces && s < s1; ++guard) {
    Ray ray = cameraRay(position);
    Airlight light = airlightOf(ray);
    float first = s0, last = s1;
    litRange(light, first, last);
    s = max(s, first);
    // The next piece that this draw walks; what comes before it is cheap.
    bool litOutside = isLitOutside != 0;
    int view = -1, owners = litOutside ? viewCount : 2 * viewCount;
    vec2 share = vec2(0.0);
    float from = s, to = s;
    for (int i = 0; i < kMostPieces && view < 0 && s < last; ++i) {
      int owner = -1;
      float end = last;
      for (int k = 0; k < owners && owner < 0; ++k) {
        vec2 own = ownInterval(k, ray, s, last);
        if (own.y <= own.x) continue;
        if (own.x <= s) owner = k;
        end = min(end, own.x <= s ? own.y : own.x);
      }
      bool inView = owner >= 0 && owner < viewCount;
      int next = -1;
      vec2 weight = vec2(1.0);
#if FADES
      if (inView && cascadeFade > 0.0) next = fadeInto(owner, ray, first, last, s, end, weight);
#endif
      if (outside && !inView && (owner >= 0 || litOutside)) addLit(light, s, end, sum);
      int candidate = turn == 0 ? owner : next;
      share = turn == 0 ? weight : 1.0 - weight;
      if (inView && share != vec2(0.0) && candidate >= views.x && candidate < views.x + views.y) view = candidate;
      from = s;
      to = end;
      turn = turn == 0 && next >= 0 ? 1 : 0;
      s = turn == 1 ? s : end;
    }
    if (view < 0) break;
    addOwned(light, viewSegment(view, ray, from, to, share), slice, sum);
  }
  return sum;
}

#endif
