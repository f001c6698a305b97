// March of the chosen samples, one step per shadow texel along the ray (Engelhardt and Dachsbacher 2010, 4.3).
// Reads sampleEnds, sources and the light's maps. Writes inscatter of one light, lines x samples, RGBA16F.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "common/airlight.glsl"
#include "common/steps.glsl"
#include "common/texelSteps.glsl"
#include "common/epipolar.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D sources;
layout(location = 0) out vec4 outInscatter;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 source = texelFetch(sources, at, 0).rg;
  bool chosen = source.x == float(at.y) || source.y == float(at.y);
  Ray ray = cameraRay(sampleAt(texelFetch(lines, ivec2(at.x, 0), 0), at.y));
  float end = chosen ? texelFetch(sampleEnds, at, 0).r : 0.0;
  outInscatter = vec4(min(lightColour * vec3(texelSteppedLight(ray, end)), vec3(65504.0)), 1.0);
}
