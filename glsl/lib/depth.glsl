// The engine's depth buffer. DEPTH_MULTISAMPLED: 0 or 1.

#if DEPTH_MULTISAMPLED
uniform sampler2DMS sceneDepth;
#else
uniform sampler2D sceneDepth;
#endif

// Depth of one sample (0 without multisampling) at a window position.
float depthAt(ivec2 pixel, int index) { return texelFetch(sceneDepth, pixel, index).r; }
