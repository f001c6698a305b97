// A face of the shadow volume: where the ray enters the shadow the airlight up to there is added, where it leaves it is
// taken away; faces behind the scene count up to the scene, where they cancel. FACES 0: the whole ray, lit.
// Reads the scene depth. Writes inscatter, RGBA32F, added up.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "common/airlight.glsl"

layout(location = 0) out vec4 outInscatter;
#if FACES
uniform float front; // 1 if counter-clockwise faces look out of the volume, else -1
in vec3 cameraPosition;
#endif

void main() {
  Ray ray = cameraRay(gl_FragCoord.xy);
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0), sign_ = 1.0;
#if FACES
  end = min(end, max(dot(cameraPosition - ray.origin, ray.direction), 0.0));
  sign_ = gl_FrontFacing ? front : -front;
#endif
  vec3 light = vec3(airlight(airlightOf(ray), 0.0, min(end, visibleEnd)));
  outInscatter = vec4(sign_ * lightColour * light, 1.0);
}
