// Edge ray: one that is marched for some of the samples that slices do not serve at an edge of a multisampled depth: the first for those
// that end nearest, the next for the nearest of the others, the last for all others. Reads edgeRest and the depth of all samples. Writes
// edgeInscatter, of which only alpha is written: their share of the pixel; sampleDepth, image size, R32F: where the ray ends.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depthSamples.glsl"

uniform sampler2D edgeRest;
layout(location = 0) out vec4 outShare;
layout(location = 1) out vec4 outDepth;

// endCoordinate of lib/stored.glsl, as of a lamp: a sun's position is no light's, and only has samples told apart that need not be.
float coordinateOf(float end, vec2 light) { return log2(max(end, 1e-30)) + atan(end - light.x, light.y); }

// How far along the ray the light is, and how far off it.
vec2 lightFrom(Ray ray) {
  vec3 toLight = lightPosition - ray.origin;
  return vec2(dot(toLight, ray.direction), max(length(cross(toLight, ray.direction)), 1e-30));
}

void main() {
  vec2 light = lightFrom(cameraRay(unjittered(gl_FragCoord.xy)));
  int left = int(texelFetch(edgeRest, ivec2(gl_FragCoord.xy), 0).r);
  float count = 0.0, sum = 0.0;
  int i = 0;
  for (; i <= depthSample && left != 0; ++i) {
    float nearest = 3e38;
    for (int k = 0; k < depthSampleCount; ++k)
      if ((left >> k & 1) != 0) nearest = min(nearest, coordinateOf(sampleEndAt(k), light));
    count = 0.0;
    sum = 0.0;
    for (int k = 0; k < depthSampleCount; ++k) {
      bool taken = (left >> k & 1) != 0 && (coordinateOf(sampleEndAt(k), light) <= nearest + endThreshold || i == EDGE_RAYS - 1);
      if (!taken) continue;
      count += 1.0;
      sum += sampleDepthAt(k);
      left &= ~(1 << k);
    }
  }
  if (i <= depthSample) count = 0.0; // none is left for this ray
  outShare = vec4(0.0, 0.0, 0.0, count / float(depthSampleCount));
  outDepth = vec4(count > 0.0 ? sum / count : depthScale * 1e30, 0.0, 0.0, 0.0); // the mean, as of plane surfaces; or at the eye
}
