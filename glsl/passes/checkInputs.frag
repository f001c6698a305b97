// Check inputs: at points of a grid over the picture (the lower half) and over the shadow map's views (the upper half), what scene
// depth and map say of each other. Reads the scene depth and a light's shadow map. Writes input checks: CHECK_WIDTH x 2 CHECK_HEIGHT
// for each light, over 255: what was found, hints (constants of lib/inputs.glsl) and the view, 255 for none.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depthSamples.glsl"
#include "lib/shadowMap.glsl"
#include "lib/inputs.glsl"

layout(location = 0) out vec4 outCheck;

void main() {
  ivec2 point = ivec2(gl_FragCoord.xy);
  point.y %= 2 * CHECK_HEIGHT;
  int found, view, hints = 0;
  if (point.y < CHECK_HEIGHT) {
    vec2 place = (vec2(point) + 0.5) / vec2(CHECK_WIDTH, CHECK_HEIGHT);
    found = surfaceInMap(ivec2(place * vec2(frameSize)), view, hints);
  } else {
    view = point.x % viewCount;
    vec2 place = vec2(float(point.x / viewCount) + 0.5, float(point.y - CHECK_HEIGHT) + 0.5) /
        vec2(ceil(float(CHECK_WIDTH) / float(viewCount)), CHECK_HEIGHT);
    found = casterInDepth(ivec2(min(place, 0.999999) * vec2(shadowViews[view].size)), view);
  }
  outCheck = vec4(found, hints, view < 0 ? 255 : view, 0) / 255.0;
}
