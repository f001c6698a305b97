// AVSM particles: spheres of an even medium, inserted into curves in the order in which they are given and in fixed memory (Salvi 2013, 4.3). A
// work group owns a tile of texels; of so many spheres at a time it finds those that touch the tile, and each texel then inserts them in order.
// Reads the particles (five floats: centre, radius, density) and curves. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#define CURVES_ACCESS
#include "lib/avsmSegment.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"
#include "lib/avsmRay.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

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

// A plane whose distance is positive before it, in world units; where it has no direction, all is before it.
vec4 scaled(vec4 plane) { return plane / max(length(plane.xyz), 1e-30); }

// Planes through the light beside a tile of texels, and the one across, behind which there is no light.
vec4 planes[5];

void findPlanes(View view, vec2 low, vec2 high) {
  vec4 x = view.rows[0], y = view.rows[1], w = view.rows[2];
  planes = vec4[5](scaled(x - low.x * w), scaled(high.x * w - x), scaled(y - low.y * w), scaled(high.y * w - y), scaled(w));
}

// False only if a sphere lies wholly behind one of the planes.
bool touches(vec4 sphere) {
  bool before = true;
  for (int i = 0; i < 5; ++i) before = before && dot(planes[i].xyz, sphere.xyz) + planes[i].w >= -sphere.w;
  return before;
}

// |start + s along - centre|^2 = radius^2, from the ray's nearest point to the centre on, where it is halfChord to either side in depth s. What
// passes is exp(-density chord), the chord in world units.
bool findSegment(Ray ray, vec4 sphere, float density, out vec3 segment) {
  vec3 centre = sphere.xyz - ray.start;
  float square = dot(ray.along, ray.along), middle = dot(ray.along, centre) / square;
  vec3 beside = centre - middle * ray.along;
  float rest = sphere.w * sphere.w - dot(beside, beside);
  if (!(rest > 0.0) || !(sphere.w > 0.0)) return false;
  float halfChord = sqrt(rest / square), entry = max(middle - halfChord, ray.behindLight), exit = middle + halfChord;
  return exit > entry && tyndallSegment(entry, exit, exp(-density * (exit - entry) * sqrt(square)), segment);
}

// Each texel looks for the next sphere that it sees by itself, so that all insert at once, and not one while the others wait.
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
