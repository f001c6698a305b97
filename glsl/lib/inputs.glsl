// What scene depth and a shadow map say of each other, where both show one scene. Needs lib/camera.glsl, lib/depthSamples.glsl and
// lib/shadowMap.glsl. Lengths within which two surfaces are one: a part of the distance to the eye, and texels of the map.

const int kNothing = 0;  // there is nothing to compare
const int kAgrees = 1;   // both show the surface
const int kHidden = 2;   // the other shows one before it
const int kMissing = 3;  // the other shows one far behind it, though this one would be before that
const int kEmpty = 4;    // the other shows none
const int kOutside = 5;  // the other does not look there
const int kQuarter = 8;  // added, of a caster: the camera shows something at less than a quarter of the distance
const int kAtNear = 16;  // added: the surface is at the camera's near plane; the caster, at the view's or nearer (and nothing else)

// Hints: a surface that the map does not have where the matrix says would agree with it ...
const int kBiased = 1;     // ... if the matrix were one for texture coordinates, from 0 to 1
const int kWholeLayer = 2; // ... if it were one into the layer of which the view has a rectangle
const int kFromTop = 4;    // ... if rectangles counted rows from the top
const int kOtherView = 8;  // ... in another view's texels
const int kTurned = 16;    // ... if the view were drawn upside down

const float kSameDistance = 0.02, kSameTexels = 3.0;

vec4 rowOf(mat4 m, int row) { return vec4(m[0][row], m[1][row], m[2][row], m[3][row]); }

// The point where three planes meet: dot(xyz, x) + w is 0 on each.
vec3 meetingPoint(vec4 a, vec4 b, vec4 c) {
  vec3 bc = cross(b.xyz, c.xyz);
  return -(a.w * bc + b.w * cross(c.xyz, a.xyz) + c.w * cross(a.xyz, b.xyz)) / dot(a.xyz, bc);
}

// The world's width of a texel of a view, at a place in texels and a weight.
float texelWidth(mat4 texelFromCamera, float place, float weight) {
  return weight / length(rowOf(texelFromCamera, 0).xyz - place * rowOf(texelFromCamera, 3).xyz);
}

// How far the camera sees in a pixel: 3e38 where there is sky, at most 0 where there is no depth.
float seenIn(ivec2 pixel) {
  float end = sampleEndOf(pixel, 0);
  return end == skyEnd ? 3e38 : end;
}

// The same to the far (t = 0) or the near plane (t = 1).
float planeAt(vec2 position, float t) {
  if (isOrthographic != 0) return (1.0 - t) * length(nearStep.xyz);
  vec2 p = position - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  float weight = far.w + t * nearStep.w;
  return weight > 0.0 ? length(far.xyz) / weight : 3e38;
}

// The view that a point belongs to, or -1; the point in it: texels, depth, weight.
int viewOf(vec3 point, out vec4 place) {
  for (int view = 0; view < viewCount; ++view) {
    vec4 q = shadowViews[view].texelFromCamera * vec4(point, 1.0);
    place = vec4(q.xyz / q.w, q.w);
    bool within = q.w > 0.0 && all(greaterThanEqual(place.xy, vec2(0.0))) && all(lessThan(place.xy, vec2(shadowViews[view].size))) &&
        place.z >= shadowViews[view].nearDepth;
    if (within && (shadowViews[view].isOpen != 0 || place.z <= shadowViews[view].farDepth)) return view;
  }
  return -1;
}

// How much nearer or farther than a point in a view a surface may be that is the same: a difference in depth.
float sameDepth(int view, vec4 place, float end) {
  mat4 m = shadowViews[view].texelFromCamera;
  vec4 x = rowOf(m, 0) - place.x * rowOf(m, 3), y = rowOf(m, 1) - place.y * rowOf(m, 3), z = rowOf(m, 2) - place.z * rowOf(m, 3);
  vec3 along = normalize(cross(x.xyz, y.xyz)); // the light's ray
  float slope = abs(dot(z.xyz, along)) / place.w; // of the depth
  return slope * (kSameDistance * end + kSameTexels * texelWidth(m, place.x, place.w));
}

// Around a place in a view's texels, which begin at `first`: the nearest depth, and the least difference to a depth.
vec2 depthsAround(int view, ivec2 first, vec2 place, float depth) {
  vec2 found = vec2(3e38);
  for (int k = 0; k < 9; ++k) {
    ivec2 texel = clamp(ivec2(place) + ivec2(k % 3, k / 3) - 1, ivec2(0), shadowViews[view].size - 1);
    float caster = casterDepth(texel + first, view);
    found = min(found, vec2(caster, abs(caster - depth)));
  }
  return found;
}

bool isAt(int view, ivec2 first, vec2 place, float depth, float same) {
  bool within = all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(shadowViews[view].size)));
  return within && depthsAround(view, first, place, depth).y <= same;
}

// What would bring the map to agree with a point that the camera shows.
int hintsFor(vec3 point, float end) {
  ivec2 layer = textureSize(shadowMap, 0).xy;
  int hints = 0;
  for (int view = 0; view < viewCount; ++view) {
    vec4 q = shadowViews[view].texelFromCamera * vec4(point, 1.0);
    if (!(q.w > 0.0)) continue;
    vec4 place = vec4(q.xyz / q.w, q.w);
    float same = sameDepth(view, place, end);
    ivec2 first = firstTexel(view), size = shadowViews[view].size;
    vec2 whole = place.xy * vec2(layer) / vec2(size) - vec2(first), biased = 2.0 * place.xy - vec2(size);
    if (isAt(view, first, biased, place.z, same) || isAt(view, first, biased, 2.0 * place.z - sign(place.z), 2.0 * same))
      hints |= kBiased;
    if (size != layer && isAt(view, first, whole, place.z, same)) hints |= kWholeLayer;
    if (size != layer && isAt(view, ivec2(first.x, layer.y - first.y - size.y), place.xy, place.z, same)) hints |= kFromTop;
    if (isAt(view, first, vec2(size) - place.xy, place.z, same)) hints |= kTurned;
    for (int other = 0; other < viewCount; ++other)
      if (other != view && shadowViews[other].size == size && place.z >= shadowViews[view].nearDepth &&
          isAt(other, firstTexel(other), place.xy, place.z, same))
        hints |= kOtherView;
  }
  return hints;
}

// A surface that the camera shows against the map.
int surfaceInMap(ivec2 pixel, out int view, out int hints) {
  view = -1;
  hints = 0;
  vec2 position = unjittered(vec2(pixel) + 0.5);
  Ray ray = cameraRay(position);
  float end = seenIn(pixel);
  if (!(end > 0.0) || end >= 3e38) return kNothing;
  int added = end < 1.5 * planeAt(position, 1.0) ? kAtNear : 0;
  vec3 point = ray.origin + end * ray.direction;
  vec4 place;
  view = viewOf(point, place);
  if (view < 0) {
    hints = hintsFor(point, end);
    return added + kOutside;
  }
  float same = sameDepth(view, place, end);
  vec2 depths = depthsAround(view, firstTexel(view), place.xy, place.z);
  if (depths.y <= same) return added + kAgrees;
  hints = hintsFor(point, end);
  if (depths.x > place.z && place.z + same > shadowViews[view].farDepth) return added + kOutside; // no map holds it
  return added + (depths.x >= 3e38 ? kEmpty : depths.x > place.z ? kMissing : kHidden);
}

// The window position of a point, and how far from where its ray begins it is; a negative distance behind the eye.
vec3 windowOf(vec3 point) {
  vec3 a = farPoint[0].xyz, b = farPoint[1].xyz, c = farPoint[2].xyz;
  vec2 middle = 0.5 * vec2(frameSize);
  if (isOrthographic != 0) {
    vec3 n = nearStep.xyz, from = point - a;
    float volume = dot(n, cross(b, c));
    return vec3(middle + vec2(dot(from, cross(c, n)), dot(from, cross(n, b))) / volume,
                (1.0 - dot(from, cross(b, c)) / volume) * length(n));
  }
  float along = dot(point, cross(b, c)) / dot(a, cross(b, c));
  vec2 p = vec2(dot(point, cross(c, a)), dot(point, cross(a, b))) / (dot(a, cross(b, c)) * along);
  return vec3(middle + p, along > 0.0 ? length(point) : -1.0);
}

// A surface that the map shows against the camera's.
int casterInDepth(ivec2 texel, int view) {
  float depth = casterDepth(texel + firstTexel(view), view);
  if (depth >= 3e38) return kNothing;
  if (depth <= shadowViews[view].nearDepth) return kNothing + kAtNear;
  mat4 m = shadowViews[view].texelFromCamera;
  vec2 place = vec2(texel) + 0.5;
  vec4 w = rowOf(m, 3);
  vec3 point = meetingPoint(rowOf(m, 0) - place.x * w, rowOf(m, 1) - place.y * w, rowOf(m, 2) - depth * w);
  vec3 seen = windowOf(point);
  vec2 shown = seen.xy + jitter;
  if (!(seen.z > 0.0) || any(lessThan(shown, vec2(0.0))) || any(greaterThanEqual(shown, vec2(frameSize)))) return kOutside;
  if (!(seen.z > planeAt(seen.xy, 1.0) && seen.z < planeAt(seen.xy, 0.0))) return kOutside;
  float same = kSameDistance * seen.z + kSameTexels * texelWidth(m, place.x, dot(w, vec4(point, 1.0)));
  float nearest = 3e38, least = 3e38;
  for (int k = 0; k < 9; ++k) {
    float end = seenIn(clamp(ivec2(shown) + ivec2(k % 3, k / 3) - 1, ivec2(0), frameSize - 1));
    nearest = min(nearest, end);
    least = min(least, abs(end - seen.z));
  }
  if (least <= same) return kAgrees;
  return nearest >= 3e38 ? kEmpty : nearest > seen.z ? kMissing : kHidden + (4.0 * nearest < seen.z ? kQuarter : 0);
}
