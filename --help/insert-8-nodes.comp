#version 430 core
#define TYNDALL_CURVE_NODES 8
#define TYNDALL_CURVE_PACKED 0
#define TYNDALL_CURVES_IMAGE 3
// Insertion: what an engine's own shaders put between a light and the scene goes into curves at once, in a fixed memory and in the order of

#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#ifndef TYNDALL_SEGMENT
#define TYNDALL_SEGMENT

bool tyndallSegment(float entry, float exit, float transmittance, out vec3 segment) {
  segment = vec3(0.0, 0.0, 1.0);
  const float most = 1e37; // so that the difference of two is finite
  if (!(abs(entry) <= most) || !(abs(exit) <= most) || isnan(transmittance)) return false;
  float near = min(entry, exit), far = max(entry, exit), passed = transmittance > 0.0 ? min(transmittance, 1.0) : 0.0;
  if (near > 1.0) return false;
  if (far > 1.0) passed = near < 1.0 ? pow(passed, (1.0 - near) / (far - near)) : 1.0;
  segment = vec3(near > 0.0 ? near : 0.0, far > 0.0 ? min(far, 1.0) : 0.0, passed);
  return passed < 1.0;
}

#endif


vec2 tyndallCurve[TYNDALL_CURVE_ROOM];
int tyndallUsed = 0;
const float kTyndallUnused = 2.0; // depth of nodes in no use: behind the far plane

void tyndallEmptyCurve() {
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i] = vec2(kTyndallUnused, 1.0);
  tyndallUsed = 0;
}

float tyndallArea(vec2 a, vec2 b, vec2 c) { return abs((c.x - a.x) * (c.y - b.y) - (c.x - b.x) * (c.y - a.y)); }

void tyndallRemoveCheapest() {
  float least = 3e38;
  int cheapest = 1;
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) {
    float area = tyndallArea(tyndallCurve[i - 1], tyndallCurve[i], tyndallCurve[i + 1]);
    if (i < tyndallUsed - 1 && area < least) {
      least = area;
      cheapest = i;
    }
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i)
    if (i >= cheapest) tyndallCurve[i] = tyndallCurve[i + 1];
  --tyndallUsed;
}

void tyndallPadCurve() {
  vec2 last = vec2(1.0);
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) {
    if (i < tyndallUsed) last = tyndallCurve[i];
    else tyndallCurve[i] = last;
  }
}

#if TYNDALL_CURVE_PACKED
const int kTyndallNodesOfTexel = 4;

uvec4 tyndallTexelFrom(int first) {
  uvec4 texel;
  for (int i = 0; i < 4; ++i) {
    uvec2 bits = uvec2(round(clamp(tyndallCurve[first + i], 0.0, 1.0) * 65535.0));
    texel[i] = bits.x << 16u | bits.y;
  }
  return texel;
}

void tyndallTakeTexel(int first, uvec4 texel) {
  for (int i = 0; i < 4; ++i) tyndallCurve[first + i] = vec2(texel[i] >> 16u, texel[i] & 0xFFFFu) * (1.0 / 65535.0);
}
#else
const int kTyndallNodesOfTexel = 2;

uvec4 tyndallTexelFrom(int first) { return floatBitsToUint(vec4(tyndallCurve[first], tyndallCurve[first + 1])); }

void tyndallTakeTexel(int first, uvec4 texel) {
  tyndallCurve[first] = uintBitsToFloat(texel.xy);
  tyndallCurve[first + 1] = uintBitsToFloat(texel.zw);
}
#endif
const int kTyndallTexelsOfCurve = TYNDALL_CURVE_NODES / kTyndallNodesOfTexel;

void tyndallFindUsed() {
  tyndallUsed = TYNDALL_CURVE_NODES;
  for (int i = TYNDALL_CURVE_NODES - 1; i > 0; --i)
    if (tyndallUsed == i + 1 && tyndallCurve[i] == tyndallCurve[i - 1]) tyndallUsed = i;
  if (tyndallUsed == 1 && tyndallCurve[0] == vec2(1.0)) tyndallUsed = 0;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i].x = i < tyndallUsed ? tyndallCurve[i].x : kTyndallUnused;
}


float tyndallPassed(vec3 segment, float perDepth, float depth) {
  float inside = exp(perDepth * min(depth - segment.x, segment.y - segment.x));
  return depth <= segment.x ? 1.0 : depth >= segment.y ? segment.z : inside;
}

float tyndallCurveBehind(float depth) {
  vec2 before = vec2(-1.0, 1.0), behind = vec2(kTyndallUnused, 1.0);
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) before = tyndallCurve[i].x <= depth ? tyndallCurve[i] : before;
  for (int i = TYNDALL_CURVE_ROOM - 1; i >= 0; --i) behind = tyndallCurve[i].x > depth ? tyndallCurve[i] : behind;
  return behind.x == kTyndallUnused ? before.y : mix(before.y, behind.y, (depth - before.x) / (behind.x - before.x));
}

void tyndallInsertSegment(vec3 segment) {
  vec2 entry = vec2(segment.x, tyndallCurveBehind(segment.x)), exit = vec2(segment.y, tyndallCurveBehind(segment.y) * segment.z);
  float perDepth = (segment.z <= 1e-7 ? -16.0 : log(segment.z)) / max(segment.y - segment.x, 1e-9); // 1e-9: nothing is inside a step
  int entryAt = 0, exitAt = 1;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    float depth = tyndallCurve[i].x;
    tyndallCurve[i].y *= tyndallPassed(segment, perDepth, depth);
    entryAt += depth <= segment.x ? 1 : 0;
    exitAt += depth <= segment.y ? 1 : 0;
  }
  for (int i = TYNDALL_CURVE_ROOM - 1; i >= 0; --i) {
    vec2 moved = i > exitAt ? tyndallCurve[max(i - 2, 0)] : i > entryAt ? tyndallCurve[max(i - 1, 0)] : i == entryAt ? entry : tyndallCurve[i];
    tyndallCurve[i] = i == exitAt ? exit : moved;
  }
  tyndallUsed += 2;
  for (int i = 0; i < 2; ++i)
    if (tyndallUsed > TYNDALL_CURVE_NODES) {
      tyndallRemoveCheapest();
      tyndallCurve[TYNDALL_CURVE_ROOM - 1].x = kTyndallUnused;
    }
}


#ifdef TYNDALL_CURVES_IMAGE
layout(rgba32ui, binding = TYNDALL_CURVES_IMAGE) coherent uniform uimage2DArray tyndallCurves;

void tyndallInsertAt(ivec3 texel, float entry, float exit, float transmittance) {
  vec3 segment;
  ivec3 first = ivec3(texel.xy, texel.z * kTyndallTexelsOfCurve);
  if (!tyndallSegment(entry, exit, transmittance, segment)) return;
  if (any(lessThan(texel, ivec3(0))) || any(greaterThanEqual(first, imageSize(tyndallCurves)))) return;
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, imageLoad(tyndallCurves, first + ivec3(0, 0, i)));
  tyndallFindUsed();
  tyndallInsertSegment(segment);
  tyndallPadCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) imageStore(tyndallCurves, first + ivec3(0, 0, i), tyndallTexelFrom(kTyndallNodesOfTexel * i));
}
#else
layout(location = 0) inout uvec4 tyndallTexels[kTyndallTexelsOfCurve];

void tyndallInsert(float entry, float exit, float transmittance) {
  vec3 segment;
  if (!tyndallSegment(entry, exit, transmittance, segment)) return;
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, tyndallTexels[i]);
  tyndallFindUsed();
  tyndallInsertSegment(segment);
  tyndallPadCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTexels[i] = tyndallTexelFrom(kTyndallNodesOfTexel * i);
}
#endif
layout(local_size_x = 1) in;
void main() { tyndallInsertAt(ivec3(0), 0.25, 0.5, 0.5); }
