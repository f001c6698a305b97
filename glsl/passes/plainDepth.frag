// Plain depth: one depth a pixel out of a part of the engine's texture, of another size, a layer, a sample or in another encoding: what
// all other passes read in its place. Reads engineDepth: DEPTH_SOURCE 0 a texture, 1 an array, 2 a multisampled one, 3 an array of
// those, of which the first sample counts. Writes plainDepth: image size, R32F, as lib/engineDepth.glsl says.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/engineDepth.glsl"

#if DEPTH_SOURCE == 0
uniform sampler2D engineDepth;
float texelAt(ivec2 texel) { return texelFetch(engineDepth, texel, 0).r; }
#elif DEPTH_SOURCE == 1
uniform sampler2DArray engineDepth;
float texelAt(ivec2 texel) { return texelFetch(engineDepth, ivec3(texel, depthLayer), 0).r; }
#elif DEPTH_SOURCE == 2
uniform sampler2DMS engineDepth;
float texelAt(ivec2 texel) { return texelFetch(engineDepth, texel, 0).r; }
#else
uniform sampler2DMSArray engineDepth;
float texelAt(ivec2 texel) { return texelFetch(engineDepth, ivec3(texel, depthLayer), 0).r; }
#endif

layout(location = 0) out vec4 outDepth;

void main() { outDepth = vec4(plainDepth(unjittered(gl_FragCoord.xy), texelAt(depthTexel(ivec2(gl_FragCoord.xy)))), 0.0, 0.0, 0.0); }
