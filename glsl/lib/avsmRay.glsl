// A light's shadow view as an adaptive volumetric shadow map has it (effect/src/avsm/Particles.h), and the rays of its texels.

struct View {
  vec4 near[3], far[3]; // of a texel's ray: the points on the two planes, homogeneous, by x, y and 1
  vec4 rows[3];         // of texelFromWorld: x, y and the weight, positive before the light
  vec4 behindLight;     // x: depth, before which there is no light
};

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
