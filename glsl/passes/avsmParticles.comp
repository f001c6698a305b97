// AVSM particles: spheres of an even medium, inserted into curves in the order in which they are given and in fixed memory (Salvi 2013, 4.3). A
// work group owns a tile of texels; 64 spheres at a time it finds those that touch the tile, and each of its texels then inserts them in order.
// Reads the particles (five floats: centre, radius, density) and curves. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#define CURVES_ACCESS
#include "lib/avsmSegment.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"

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

shared vec4 spheres[64];
shared float densities[64];
shared uint touching[2]; // a bit for each of them

float valueAt(vec4 plane, vec4 sphere) { return dot(plane.xyz, sphere.xyz) + plane.w + sphere.w * length(plane.xyz); }

// Whether any part of a sphere may lie in the tile of texels from low to high: false only if it is wholly on the far side of one of its planes.
bool touches(View view, vec4 sphere, vec2 low, vec2 high) {
  vec4 w = view.rows[2];
  return valueAt(w, sphere) >= 0.0 && valueAt(view.rows[0] - low.x * w, sphere) >= 0.0 && valueAt(high.x * w - view.rows[0], sphere) >= 0.0 &&
         valueAt(view.rows[1] - low.y * w, sphere) >= 0.0 && valueAt(high.y * w - view.rows[1], sphere) >= 0.0;
}

// A texel's ray, by depth: from the near plane at 0 to the far plane at 1.
struct Ray {
  vec3 start, along;
  float behindLight;
};

Ray rayOf(View view, vec2 at) {
  vec4 near = view.near[0] * at.x + view.near[1] * at.y + view.near[2], far = view.far[0] * at.x + view.far[1] * at.y + view.far[2];
  vec3 start = near.xyz / near.w;
  return Ray(start, far.xyz / far.w - start, view.behindLight.x);
}

// |start + s along - centre|^2 = radius^2, from the ray's nearest point to the centre on, where it is halfChord to either side in depth s. What
// passes is exp(-density chord), the chord in world units.
void insertSphere(Ray ray, vec4 sphere, float density) {
  vec3 centre = sphere.xyz - ray.start;
  float square = dot(ray.along, ray.along), middle = dot(ray.along, centre) / square;
  vec3 beside = centre - middle * ray.along;
  float rest = sphere.w * sphere.w - dot(beside, beside);
  if (!(rest > 0.0) || !(sphere.w > 0.0)) return;
  float halfChord = sqrt(rest / square), entry = max(middle - halfChord, ray.behindLight), exit = middle + halfChord;
  vec3 segment;
  if (exit > entry && tyndallSegment(entry, exit, exp(-density * (exit - entry) * sqrt(square)), segment)) tyndallInsertSegment(segment);
}

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  View view = views[texel.z];
  vec2 low = vec2(8u * gl_WorkGroupID.xy);
  Ray ray = rayOf(view, vec2(texel.xy) + 0.5);
  tyndallEmptyCurve();
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) tyndallTakeTexel(kTyndallNodesOfTexel * i, imageLoad(curveImage, placeOf(texel, i)));
  tyndallFindUsed();
  uint own = gl_LocalInvocationIndex;
  for (int first = 0; first < count; first += 64) {
    barrier(); // the last spheres are done with
    if (own < 2u) touching[own] = 0u;
    barrier();
    int index = first + int(own), at = firstFloat + stride * index;
    if (index < count) {
      vec4 sphere = vec4(particles[at], particles[at + 1], particles[at + 2], particles[at + 3]);
      spheres[own] = sphere;
      densities[own] = particles[at + 4];
      if (touches(view, sphere, low, low + 8.0)) atomicOr(touching[own >> 5u], 1u << (own & 31u));
    }
    barrier();
    for (int word = 0; word < 2; ++word)
      for (uint bits = touching[word]; bits != 0u; bits &= bits - 1u) {
        int hit = 32 * word + findLSB(bits);
        insertSphere(ray, spheres[hit], densities[hit]);
      }
  }
  tyndallPadCurve();
  if (all(lessThan(texel.xy, imageSize(curveImage).xy))) storeCurve(texel);
}
