// Texels of the light's shadow map and glass map, in one convention: depth grows away from the light. Texels are those of a view's
// layer: of them the view has its own rectangle alone.
// SHADOW_ARRAY, FILTER_BILINEAR, GLASS: 0 or 1.

#if SHADOW_ARRAY
uniform sampler2DArray shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, ivec3(texel, shadowViews[view].layer), 0)
#else
uniform sampler2D shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, texel, 0)
#endif
#if GLASS
#if SHADOW_ARRAY
uniform sampler2DArray glassColour;
uniform sampler2DArray glassDepth;
#else
uniform sampler2D glassColour;
uniform sampler2D glassDepth;
#endif
#endif

// Depth stored in a texel, growing away from the light; a texel without a caster never blocks, nor does one that is not a number,
// which makes comparisons false.
float casterDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(shadowMap, texel, view).r;
  return depth < shadowViews[view].farDepth ? depth : 3e38;
}

#if GLASS
// The same of the glass: one that is not a number has nothing behind it.
float paneDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(glassDepth, texel, view).r;
  return depth < 3e38 ? depth : 3e38;
}
// NaN and negative values count as black, values above 1 as clear.
vec3 paneTint(ivec2 texel, int view) {
  vec3 tint = TEXEL(glassColour, texel, view).rgb;
  return mix(vec3(0.0), min(tint, vec3(1.0)), greaterThanEqual(tint, vec3(0.0)));
}
#endif

// The view's first texel, and its last. Filtered glass, which takes most registers, has views that begin at the layer's first: else the
// light's maps are copied (plan/MapCopies.cpp).
#if FILTER_BILINEAR && GLASS
ivec2 firstTexel(int view) { return ivec2(0); }
#else
ivec2 firstTexel(int view) { return shadowViews[view].origin; }
#endif
ivec2 lastTexel(int view) { return firstTexel(view) + shadowViews[view].size - 1; }

// The four texels around a cell (bilinear), clamped to the view's edge: low x low y, high x low y, low x high y, both high.
vec4 cornerDepths(ivec2 cell, int view) {
  ivec2 low = max(cell, firstTexel(view)), high = min(cell + 1, lastTexel(view));
  return vec4(casterDepth(low, view), casterDepth(ivec2(high.x, low.y), view), casterDepth(ivec2(low.x, high.y), view),
              casterDepth(high, view));
}

#if GLASS
vec4 cornerPanes(ivec2 cell, int view) {
  ivec2 low = max(cell, firstTexel(view)), high = min(cell + 1, lastTexel(view));
  return vec4(paneDepth(low, view), paneDepth(ivec2(high.x, low.y), view), paneDepth(ivec2(low.x, high.y), view),
              paneDepth(high, view));
}

// The same where clear glass is no glass.
float tintedDepth(ivec2 texel, int view) { return paneTint(texel, view) == vec3(1.0) ? 3e38 : paneDepth(texel, view); }
vec4 cornersTinted(ivec2 cell, int view) {
  ivec2 low = max(cell, firstTexel(view)), high = min(cell + 1, lastTexel(view));
  return vec4(tintedDepth(low, view), tintedDepth(ivec2(high.x, low.y), view), tintedDepth(ivec2(low.x, high.y), view),
              tintedDepth(high, view));
}

vec3 cornerTint(ivec2 cell, int i, int view) { return paneTint(clamp(cell + ivec2(i & 1, i >> 1), firstTexel(view), lastTexel(view)), view); }
#endif
