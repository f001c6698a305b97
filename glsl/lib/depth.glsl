// The engine's depth buffer, of one sample.

uniform sampler2D sceneDepth;

float depthAt(ivec2 pixel) { return texelFetch(sceneDepth, pixel, 0).r; }
