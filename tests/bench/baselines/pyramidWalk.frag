// Every pixel's ray through a min/max pyramid of the shadow map, node by node (as Tevs et al. 2008 walk height fields):
// up a level where a node changes nothing, down where it may. Exact but for rounding.
// Reads the pyramid (its level l - 1 holds squares of 2^l texels), the scene depth and the light's map.
// Writes inscatter of one directional light, and transmittance.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"
#include "common/final.glsl"

uniform sampler2D pyramid;
uniform int top; // the coarsest level

// Where a walk stands: at distance s in a texel, as part of a node of a level.
struct Walk {
  ivec2 texel;
  int level;
  float s;
};

vec2 nodeBounds(Walk walk) {
  if (walk.level == 0) return vec2(casterDepth(walk.texel, 0));
  return texelFetch(pyramid, walk.texel >> walk.level, walk.level - 1).rg;
}

// Distance at which the ray leaves the walk's node; axis: 0 or 1.
float nodeEnd(ViewLine line, Walk walk, float to, out int axis) {
  ivec2 next = ((walk.texel >> walk.level) + ivec2(greaterThan(line.slope.xy, vec2(0.0)))) << walk.level;
  vec2 exits = mix(vec2(3e38), (vec2(next) - line.origin.xy) / line.slope.xy, notEqual(line.slope.xy, vec2(0.0)));
  axis = exits.x < exits.y ? 0 : 1;
  return clamp(min(exits.x, exits.y), walk.s, to);
}

// Into the next node, and up where that belongs to another parent.
void leaveNode(ViewLine line, inout Walk walk, float s, int axis) {
  ivec2 low = (walk.texel >> walk.level) << walk.level, high = low + (1 << walk.level) - 1, before = walk.texel;
  walk.s = s;
  walk.texel = clamp(ivec2(floor(line.origin.xy + s * line.slope.xy)), low, high);
  walk.texel[axis] = line.slope[axis] > 0.0 ? high[axis] + 1 : low[axis] - 1;
  bool otherParent = (walk.texel >> (walk.level + 1)) != (before >> (walk.level + 1));
  walk.level = otherParent ? min(walk.level + 1, top) : walk.level;
}

Light walkedLight(Airlight light, ViewLine line, float from, float to) {
  ivec2 last = shadowViews[0].size - 1;
  Walk walk = Walk(clamp(ivec2(floor(line.origin.xy + from * line.slope.xy)), ivec2(0), last), top, from);
  int guard = 8 * (last.x + last.y + 2); // bounds the loops whatever the arithmetic does
  Light sum = Light(0.0);
  bool lit = true;
  float begin = from;
  while (walk.s < to && guard > 0) {
    int axis = 0;
    float end = to, z0 = 0.0, z1 = 0.0;
    vec2 bounds = vec2(0.0);
    bool walking = true;
    while (walking) {
      end = nodeEnd(line, walk, to, axis);
      bounds = nodeBounds(walk);
      z0 = line.origin.z + walk.s * line.slope.z;
      z1 = line.origin.z + end * line.slope.z;
      bool same = lit ? max(z0, z1) <= bounds.x : min(z0, z1) > bounds.y;
      walking = (same || walk.level > 0) && --guard > 0;
      if (same) leaveNode(line, walk, end, axis);
      else if (walking) --walk.level;
      walking = walking && walk.s < to && all(greaterThanEqual(walk.texel, ivec2(0))) && all(lessThanEqual(walk.texel, last));
    }
    bool outside = any(lessThan(walk.texel, ivec2(0))) || any(greaterThan(walk.texel, last));
    if (outside || walk.s >= to) break;
    // One texel, in which the visibility changes: at its begin, or where the ray crosses its depth.
    float crossing = (bounds.x - line.origin.z) / line.slope.z;
    bool litThere = z0 <= bounds.x, crosses = crossing > walk.s && crossing < end && litThere == lit;
    float change = crosses ? crossing : walk.s;
    if (lit) sum += airlight(light, begin, change);
    lit = !lit;
    begin = change;
    walk.s = change;
    if ((lit ? max(crosses ? bounds.x : z0, z1) <= bounds.x : z1 > bounds.x)) leaveNode(line, walk, end, axis);
  }
  if (lit) sum += airlight(light, begin, to);
  return sum;
}

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  Ray ray = cameraRay(gl_FragCoord.xy);
  Airlight light = airlightOf(ray);
  float s1 = min(end, visibleEnd), from = 0.0, to = s1;
  ViewLine line = viewLine(0, ray);
  clipToSides(line, from, to);
  Light sum = Light(0.0);
  if (!(to > from)) from = to = s1;
  if (isLitOutside != 0 && from > 0.0) sum += airlight(light, 0.0, from);
  if (isLitOutside != 0 && to < s1) sum += airlight(light, to, s1);
  if (to > from) sum += walkedLight(light, line, from, to);
  writeFinal(lightColour * vec3(sum), end);
}
