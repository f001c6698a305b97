// Uniform blocks and limits, read by the shader compiler and by the C++ compiler (effect/src/SharedBlocks.h), so that
// both see one layout. Every member is a vec4, ivec4 or mat4 (or an array of them): std140 and C++ then agree.
//
// Positions are relative to the eye (perspective) or to the centre of the clip volume (orthographic), in world units and
// world orientation: no shader adds a world position.

#define MAX_CONSTITUENTS 4
#define MAX_SHADOW_VIEWS 6
#define MAX_DEPTH_SAMPLES 16
#define EPIPOLE_GAP 0.25 // pixels between an epipole in the image and where slices begin
#define LAMP_PIXELS 32.0 // around a lamp in the image, where every pixel is marched by itself: its light is brightest there

UNIFORM_BLOCK(FrameBlock) {
  // The homogeneous point at window position p and t (0 at the far depth, 1 at the near depth) is
  // farPoint[0] + p.x farPoint[1] + p.y farPoint[2] + t nearStep, p in pixels from the image's centre.
  vec4 farPoint[3];
  vec4 nearStep;
  vec4 depthToT;                      // x + y * depth = t; z: 1 if orthographic; w: ray length for the sky
  vec4 extinction;                    // sigma_t, rgb; w: ray length beyond which nothing visible is added
  vec4 scattering[MAX_CONSTITUENTS];  // sigma_k times the norm of p_k, rgb
  vec4 phaseShape[MAX_CONSTITUENTS];  // a, b, c, side: p_k ~ (1 + c cos^2) (a + b (1 -+ cos))^(-3/2), - for side > 0
  vec4 limits;                        // x: largest radiance that the target's format holds
  ivec4 counts;                       // constituents, samples of the depth texture, image width, image height
};

UNIFORM_BLOCK(LightBlock) {
  vec4 lightColour;                   // irradiance or radiant intensity, rgb
  vec4 lightDirection;                // unit; where a directional light travels to, the axis of a spot
  vec4 lightPosition;                 // point, spot; w: range, 0 if without limit
  vec4 cone;                          // cos(outer), cos(inner), 1 / (cos(inner) - cos(outer)) or 0 for a hard edge,
                                      // w: panels (in x of airlight.glsl) up to which two nodes resolve the falloff
  vec4 coneSinSquared;                // sin^2(outer), sin^2(inner)
  vec4 boundary;                      // the light's path in the medium at x is max(0, dot(xyz, x) + w); all 0 if none
  vec4 fade;                          // x: share of a view's width over which it fades into the next
  ivec4 viewCounts;                   // shadow views, 1 if lit outside of them, shadow map width, height
  mat4 texelFromCamera[MAX_SHADOW_VIEWS]; // (x, y, z, 1) to (texel x, texel y, depth, 1) w; depth grows away from the light
  vec4 viewDepth[MAX_SHADOW_VIEWS];   // depth of near and far plane, sign of stored depth, 1 if open beyond the far plane
  vec4 viewMargin[MAX_SHADOW_VIEWS];  // what lies beyond a side by at most xy + s zw (x, y times w), which is rounding, belongs to the view
  ivec4 viewLayer[MAX_SHADOW_VIEWS];  // array layer in x
  vec4 curveDepth[MAX_SHADOW_VIEWS];  // depth of the curves (lib/curves.glsl) at x: dot(xyz, x) + w, 0 at the near and 1 at the far plane
  ivec4 curveCounts;                  // texels per side of their map, nodes of one, 1 if packed, texels that hold one
};

// Epipolar sampling (Yusov 2013). Window positions are in pixels as gl_FragCoord.xy; the border is the rectangle through
// the outermost pixel centres.
UNIFORM_BLOCK(EpipolarBlock) {
  vec4 epipole;       // homogeneous window position of the light (x, y, w), w: sign of w
  vec4 border;        // low x, low y, high x, high y
  vec4 sliceMap;      // arc length of the border where the slices begin, arc length per slice, perimeter; w: 1 if closed
  vec4 thresholds;    // x: relative change of distance that is a break, y: least bilateral weight, z: bend of the inscatter that is refined
  vec4 spread;        // x: spread of the samples around a pixel, as a part of the picture's mean, over which it is marched by itself;
                      // y: optical depth of a stretch of a row that is taken by its average
  vec4 rowCode;       // coded depth of a row = x depth + y; z: that of a texel without a caster; w: 65535 if it is stored in 16 bit, else 0
  vec4 lowRankRay;    // low rank (lib/lowRank.glsl): first coordinate of the grid of camera rays, samples a unit; z: terms
  vec4 lowRankLight;  // extent of the grid of light rays; y: 1 if each slice has factors of its own; z: where the grid begins
  ivec4 grid;         // slices, samples, texels of a row, levels of the tree or 0: none
  ivec4 march;        // shadow views of a draw: the first, how many; z: 1 for the draw that brings what is outside all views; w: of the light
  ivec4 refresh;      // temporal reuse: slices that are drawn anew though nothing has changed: the first, one past the last
};
