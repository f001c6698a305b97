#version 430 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define TYNDALL_CURVE_NODES 16
#define TYNDALL_CURVE_PACKED 1
// AVSM particles: spheres of an even medium, inserted into curves in the order in which they are given and in fixed memory (Salvi 2013, 4.3). A
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#define CURVES_ACCESS
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


#ifndef CURVES_ACCESS
#define CURVES_ACCESS writeonly
#endif
layout(rgba32ui, binding = 0) CURVES_ACCESS uniform uimage2DArray curveImage;

ivec3 placeOf(ivec3 texel, int i) { return ivec3(texel.xy, texel.z * kTyndallTexelsOfCurve + i); }

void storeCurve(ivec3 texel) {
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) imageStore(curveImage, placeOf(texel, i), tyndallTexelFrom(kTyndallNodesOfTexel * i));
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


layout(local_size_x = 8, local_size_y = 8) in;

struct View {
  vec4 near[3], far[3]; // of a texel's ray: the points on the two planes, homogeneous, by x, y and 1
  vec4 rows[3];         // of texelFromWorld: x, y and the weight, positive before the light
  vec4 behindLight;     // x: depth, before which there is no light
};
layout(std140, binding = 0) uniform ParticlesBlock {
  View views[6];
};
layout(std430, binding = 0) readonly buffer Particles {
  float particles[];
};
uniform int firstFloat, stride, count; // of the particles, in floats

const int kAtOnce = 2048; // spheres between two barriers
shared uint touching[kAtOnce / 32]; // a bit for each of them

vec4 sphereAt(int index) {
  int at = firstFloat + stride * index;
  return vec4(particles[at], particles[at + 1], particles[at + 2], particles[at + 3]);
}

vec4 scaled(vec4 plane) { return plane / max(length(plane.xyz), 1e-30); }

vec4 planes[5];

void findPlanes(View view, vec2 low, vec2 high) {
  vec4 x = view.rows[0], y = view.rows[1], w = view.rows[2];
  planes = vec4[5](scaled(x - low.x * w), scaled(high.x * w - x), scaled(y - low.y * w), scaled(high.y * w - y), scaled(w));
}

bool touches(vec4 sphere) {
  bool before = true;
  for (int i = 0; i < 5; ++i) before = before && dot(planes[i].xyz, sphere.xyz) + planes[i].w >= -sphere.w;
  return before;
}

struct Ray {
  vec3 start, along;
  float behindLight;
};

Ray rayOf(View view, vec2 at) {
  vec4 near = view.near[0] * at.x + view.near[1] * at.y + view.near[2], far = view.far[0] * at.x + view.far[1] * at.y + view.far[2];
  vec3 start = near.xyz / near.w;
  return Ray(start, far.xyz / far.w - start, view.behindLight.x);
}

bool findSegment(Ray ray, vec4 sphere, float density, out vec3 segment) {
  vec3 centre = sphere.xyz - ray.start;
  float square = dot(ray.along, ray.along), middle = dot(ray.along, centre) / square;
  vec3 beside = centre - middle * ray.along;
  float rest = sphere.w * sphere.w - dot(beside, beside);
  if (!(rest > 0.0) || !(sphere.w > 0.0)) return false;
  float halfChord = sqrt(rest / square), entry = max(middle - halfChord, ray.behindLight), exit = middle + halfChord;
  return exit > entry && tyndallSegment(entry, exit, exp(-density * (exit - entry) * sqrt(square)), segment);
}

void insertTouching(Ray ray, int first, int end) {
  uint bits = touching[0];
  bool found = true;
  for (int word = 0; found;) {
    vec3 segment;
    found = false;
    while (!found && word < end) {
      if (bits == 0u) {
        word += 32;
        bits = word < end ? touching[word >> 5] : 0u;
      } else {
        int hit = first + word + findLSB(bits);
        bits &= bits - 1u;
        found = findSegment(ray, sphereAt(hit), particles[firstFloat + stride * hit + 4], segment);
      }
    }
    if (found) tyndallInsertSegment(segment);
  }
}

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  View view = views[texel.z];
  vec2 low = vec2(8u * gl_WorkGroupID.xy);
  findPlanes(view, low, low + 8.0);
  Ray ray = rayOf(view, vec2(texel.xy) + 0.5);
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, imageLoad(curveImage, placeOf(texel, i)));
  tyndallFindUsed();
  int own = int(gl_LocalInvocationIndex);
  for (int first = 0; first < count; first += kAtOnce) {
    barrier(); // the last ones are done with
    touching[own] = 0u;
    barrier();
    int end = min(count - first, kAtOnce);
    for (int i = own; i < end; i += 64)
      if (touches(sphereAt(first + i))) atomicOr(touching[i >> 5], 1u << (i & 31));
    barrier();
    insertTouching(ray, first, end);
  }
  tyndallPadCurve();
  if (all(lessThan(texel.xy, imageSize(curveImage).xy))) storeCurve(texel);
}
