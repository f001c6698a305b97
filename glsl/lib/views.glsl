// Which shadow view a stretch of a camera ray belongs to, and how cascades fade into one another. Included by shadow.glsl.

// What a view's own segment contributes: texel by texel (segmentLight), or along a slice's row (rowLight).
#if SHADOW_VIEWS > 0
Light ownedLight(Airlight light, ViewSegment segment, int slice);
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
  vec2 inset = cascadeFade * vec2(shadowMapSize), end = vec2(shadowMapSize) - inset;
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
  vec2 place = q.xy / (q.w * vec2(shadowMapSize)), side = min(place, 1.0 - place);
  float least = min(side.x, side.y), far = shadowViews[view].farDepth;
  if (shadowViews[view].isOpen == 0) least = min(least, (far - q.z / q.w) / (far - shadowViews[view].nearDepth));
  return clamp(least / cascadeFade, 0.0, 1.0);
}

// Where a view that owns [s, end] fades, the next view that reaches there has the rest of the weight: returns that one, or
// -1, and cuts `end` so that the owner's weights at the ends of the piece stand for all of it.
int fadeInto(int owner, Ray ray, vec2 owned[kMostOwned], float s0, float s1, float s, inout float end, out vec2 weight) {
  int next = -1;
  weight = vec2(1.0);
  for (int i = owner + 1; i < viewCount && next < 0; ++i) {
    if (owned[i].y <= s || owned[i].y <= owned[i].x) continue;
    if (owned[i].x <= s) next = i;
    end = min(end, owned[i].x <= s ? owned[i].y : owned[i].x);
  }
  if (next < 0) return -1;
  vec2 whole = wholeInterval(owner, ray, s0, s1);
  bool hasWhole = whole.y > whole.x, before = hasWhole && s < whole.x, behind = hasWhole && s >= whole.y;
  if (hasWhole && !before && !behind) {
    end = min(end, whole.y);
    return -1;
  }
  float first = behind ? whole.y : owned[owner].x, last = before ? whole.x : owned[owner].y;
  end = min(min(end, last), s + max((last - first) / float(hasWhole ? kFadeSteps : kCornerSteps), 1e-6 * abs(s)));
  weight = vec2(viewWeight(owner, ray, s), viewWeight(owner, ray, end));
  return next;
}

#endif

// In-scattered light of [s0, s1] of the ray, shadowed: each view's own part walked, the rest lit or dark. Of the views just
// `views.y` from view `views.x` on; outside: what is in no view, too. The slice is for ownedLight.
Light shadowedLight(Airlight light, Ray ray, float s0, float s1, ivec2 views, bool outside, int slice) {
  if (!(s1 > s0)) return Light(0.0);
#if SHADOW_VIEWS == 0
  return Light(airlight(light, s0, s1));
#else
#if SHADOW_VIEWS == 1
  const int kViews = 1;
#else
  int kViews = viewCount;
#endif
  bool litOutside = isLitOutside != 0;
  // Intervals of the views and, where the outside is dark, of the lit parts before their near planes.
  vec2 owned[kMostOwned];
  int count = litOutside ? kViews : 2 * kViews;
  for (int i = 0; i < count; ++i) {
    vec2 interval = viewInterval(i < kViews ? i : i - kViews, ray, s0, s1, i >= kViews);
    // Not owned[i]: where pixels of a quad have left a loop before the others, softpipe stores at the i of one of those.
#define STORE(k) owned[k] = i == k ? interval : owned[k];
    STORE(0) STORE(1)
#if SHADOW_VIEWS == 2
    STORE(2) STORE(3) STORE(4) STORE(5) STORE(6) STORE(7) STORE(8) STORE(9) STORE(10) STORE(11)
#endif
  }
  Light sum = Light(0.0);
  float s = s0;
  int turn = 0; // of the two views that share a fade
  for (int guard = 0; guard < kMostPieces && s < s1; ++guard) {
    // The next piece that this draw walks; what comes before it is cheap.
    int view = -1;
    vec2 share = vec2(0.0);
    float from = s, to = s;
    for (int i = 0; i < kMostPieces && view < 0 && s < s1; ++i) {
      int owner = -1;
      float end = s1;
      for (int k = 0; k < count && owner < 0; ++k) {
        if (owned[k].y <= s || owned[k].y <= owned[k].x) continue;
        if (owned[k].x <= s) {
          owner = k;
          end = min(end, owned[k].y);
        } else {
          end = min(end, owned[k].x);
        }
      }
      bool inView = owner >= 0 && owner < kViews;
      int next = -1;
      vec2 weight = vec2(1.0);
#if FADES
      if (inView && cascadeFade > 0.0) next = fadeInto(owner, ray, owned, s0, s1, s, end, weight);
#endif
      if (outside && !inView && (owner >= 0 || litOutside)) sum += Light(airlight(light, s, end));
      int candidate = turn == 0 ? owner : next;
      share = turn == 0 ? weight : 1.0 - weight;
      if (inView && share != vec2(0.0) && candidate >= views.x && candidate < views.x + views.y) view = candidate;
      from = s;
      to = end;
      turn = turn == 0 && next >= 0 ? 1 : 0;
      s = turn == 1 ? s : end;
    }
    if (view >= 0) sum += ownedLight(light, viewSegment(view, ray, from, to, share), slice);
  }
  return sum;
#endif
}
