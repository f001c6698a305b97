// Uniform blocks and limits, read by the shader compiler and by the C++ compiler (effect/src/SharedBlocks.h), so that
// both see one layout. Every row of a block is 16 bytes: a vec4, four scalars, a vec3 and a scalar, two scalars and a pair, or one of a
// matrix or an array of rows; what is not used of one is named padding. std140 and C++ then agree. Members are global names to shaders.
//
// Positions are relative to the eye (perspective) or to the centre of the clip volume (orthographic), in world units and
// world orientation: no shader adds a world position.

#define MAX_CONSTITUENTS 4
#define MAX_HEIGHT_LAYERS 2
#define AMBIENT_TERMS 9 // spherical harmonics that tell light of the surroundings
#define AMBIENT_ROWS 36 // so many of what is the same everywhere, of each layer, and of fog before the eye
#define MAX_SHADOW_VIEWS 6
#define EDGE_RAYS 3 // that are marched for samples at an edge of a multisampled depth, at most
#define EPIPOLE_GAP 0.25 // pixels between an epipole in the image and where slices begin
#define CHECK_WIDTH 64 // points where scene depth and shadow maps are compared (Config::checkInputs), of a picture
#define CHECK_HEIGHT 36
#define ESTIMATE_CODES 512  // fragments that stand for the most that sliceEstimate.frag can say: so many for a share of 1, or
#define ESTIMATE_LEAST 384  // for an error 2^((fragments - ESTIMATE_LEAST) / ESTIMATE_OCTAVE)
#define ESTIMATE_OCTAVE 16
#define SLICE_BLOCK 8 // slices of a block, of which some are drawn (lib/slices.glsl)
#define SLICE_BUDGETS 192 // prices of slices that are tried (sliceBudget.frag); at the last no block gets more than its least
#define LOOKUP_LAYERS 3 // of a look-up that are drawn at once,
#define LOOKUP_COLUMNS 8 // that stand side by side while light is added up
#define LAMP_PIXELS 32.0 // around a lamp in the image, where every pixel is marched by itself: its light is brightest there

UNIFORM_BLOCK(FrameBlock) {
  // The homogeneous point at window position p and t (0 at the far depth, 1 at the near depth) is
  // farPoint[0] + p.x farPoint[1] + p.y farPoint[2] + t nearStep, p in pixels from the image's centre.
  vec4 farPoint[3];
  vec4 nearStep;
  float depthOffset, depthScale;      // t = depthOffset + depthScale * depth, of what passes read (lib/engineDepth.glsl)
  int isOrthographic;
  float skyEnd;                       // ray length for the sky
  vec3 extinction;                    // sigma_t, of what is the same everywhere
  float visibleEnd;                   // ray length beyond which nothing visible is added
  vec4 phaseWeight[MAX_CONSTITUENTS]; // share of sigma_k in the scattering of all constituents, rgb, times the norm of p_k; the layer + 1 or 0
  vec4 phaseShape[MAX_CONSTITUENTS];  // a, b, c, side: p_k ~ (1 + c cos^2) (a + b (1 -+ cos))^(-3/2), - for side > 0
  float lightCeiling;                 // largest radiance that a light may add,
  float colourMax, outputMax;         // that the colour's format holds, the output's
  int isMultisampled;                 // the texture of samples that passes read
  int constituentCount;
  int depthSampleCount;               // of a pixel
  ivec2 frameSize;                    // of the image, pixels
  ivec2 depthFirst, depthSize;        // the engine's depth: texels that show the image,
  int depthLayer, depthEncoding;      // of an array; 0 window depth, 1 axial, 2 radial, 3 logarithmic,
  float depthUnit, depthZero;         // distance of its values: depthUnit depth + depthZero; logarithmic: depthZero (2^(depthUnit depth) - 1)
  vec3 depthAxis;                     // along which axial distance grows, unit
  float skyRounding;                  // share of its distance by which a value of the far plane may lie before it
  vec2 jitter;                        // by how many pixels the image has been moved: rays are those of the camera at rest
  int depthSample;                    // of several a pixel, or of EDGE_RAYS, the one that is drawn; -1: none
  int depthSampleShift;               // samples of a pixel, 2^s, that stand side by side where they are not in a multisampled texture
  // Layers that thin out with height (lib/height.glsl): density exp(-max(dot(xyz, x) + w, ground)),
  vec4 layerUp[MAX_HEIGHT_LAYERS];
  vec4 layerExtinction[MAX_HEIGHT_LAYERS]; // sigma_t where density is 1; w: ground
  int layerCount;
  int dimsBackground;                 // 0 for a medium that only adds light
  int lookupDepths, lookupFirst;      // layers of a look-up (lib/lookup.glsl), the first of those that are drawn
  ivec2 lookupSize;                   // texels of a layer
  float lookupNear, lookupGrowth;     // layer i is at lookupNear 2^(i lookupGrowth)
  // Curves before the eye (lib/eyeCurves.glsl): texels per side, 1 if packed, texels that hold one; depth dot(xyz, x) + w,
  int eyeCurvesSize, eyeCurvesPacked, texelsPerEyeCurve;
  int framePadding0;
  vec4 eyeCurveDepth;                 // 0 and 1 at the planes between which they were captured
  // What they take of light may be scattered: the phase function's a, b, c, side; albedo times its norm over the scattering that lightColour holds;
  vec4 fogShape;
  vec3 fogScattering;
  int isFogLit;                       // 1 if any is
  vec3 mediumScatters;                // 1 in channels in which the medium itself scatters, else 0
  int fogDimsBackground;              // 1 if they dim the picture behind, too
};

// Light of the surroundings (passes/ambient.frag).
UNIFORM_BLOCK(AmbientBlock) {
  // What the constituents that are the same everywhere scatter of it towards the eye, along a unit of length, and then those that follow
  // each layer, where density is 1, and what curves before the eye take, as parts of ambientScale: nine coefficients each of 1, y, z, x, x y, y z, 3 z^2 - 1, x z, x^2 - y^2 of the ray's direction.
  vec4 ambientHarmonics[AMBIENT_ROWS];
  ivec2 occlusionSize;                // of the texture; 0: there is none
  float ambientScale;
  int ambientPadding0;
};

// A view of a light's shadow map.
struct MapView {
  mat4 texelFromCamera;               // (x, y, z, 1) to (texel x, texel y, depth, 1) w; depth grows away from the light
  vec4 margin;                        // what lies beyond a side by at most xy + s zw (x, y times w), which is rounding, belongs to the view
  vec4 curveDepth;                    // depth of the curves (lib/curves.glsl) at x: dot(xyz, x) + w, 0 at the near and 1 at the far plane
  float nearDepth, farDepth;          // of the near and the far plane
  float depthSign;                    // of stored depth
  int isOpen;                         // 1 if open beyond the far plane
  ivec2 origin, size;                 // texels of its layer that show it
  int layer;                          // of an array
  int viewPadding0, viewPadding1, viewPadding2;
};

UNIFORM_BLOCK(LightBlock) {
  vec3 lightColour;                   // irradiance or radiant intensity times the scattering coefficient of all constituents
  int isLitOutside;                   // 1 if lit outside of the shadow views
  vec3 lightDirection;                // unit; where a directional light travels to, the axis of a spot
  float cascadeFade;                  // share of a shadow view's width over which it fades into the next
  vec3 lightPosition;                 // point, spot
  float lightRange;                   // 0 if without limit
  float outerCosine, innerCosine;     // of a spot's cone; -1 of a point light
  float outerSineSquared, innerSineSquared;
  float falloffScale;                 // 1 / (innerCosine - outerCosine), or 0 for a hard edge
  float falloffPanel;                 // panels (in x of airlight.glsl) up to which two nodes resolve the falloff
  int lightPadding0, lightPadding1;
  vec4 boundary;                      // the light's path in the medium at x is max(0, dot(xyz, x) + w); all 0 if none
  int viewCount;                      // shadow views
  int curvesSize, curvesPacked;       // curves: texels per side of their map, 1 if packed,
  int texelsPerCurve;                 // texels that hold one
  MapView shadowViews[MAX_SHADOW_VIEWS];
};

// A light's shadow view whose maps are copied (passes/mapCopy.frag). Places are x, y of its clip space.
UNIFORM_BLOCK(CopyBlock) {
  vec4 copiedRay[3];                  // the ray at (x, y): [0] + x [1] + y [2], z along the view's axis, where it is 1
  vec4 copiedDepth;                   // window depth at d along the axis: x + dot(yz, place) + w / d, if orthographic + w d
  float copiedUnit, copiedOffset;     // of stored depth: d = offset + unit * depth
  float copiedFar;                    // d of the far plane,
  float copiedRounding;               // from which stored depth may be so far off
  ivec2 copiedOrigin, copiedSize;     // texels of its layer that show the view
  int copiedLayer;                    // of an array, or face of a cube map's
  int copiedEncoding;                 // 0 window depth, 1 d along the axis, 2 d along the ray
  int copiedIsOrthographic;
  float copiedFarDepth;               // window depth of the far plane
};

// Epipolar sampling (Yusov 2013). Window positions are in pixels as gl_FragCoord.xy; the border is the rectangle through
// the outermost pixel centres, around a single row or column of pixels a little wide.
UNIFORM_BLOCK(EpipolarBlock) {
  vec3 epipole;                       // homogeneous window position of the light (x, y, w)
  float epipoleSign;                  // of its w
  vec4 border;                        // low x, low y, high x, high y
  float slicesBegin, sliceWidth;      // arc length of the border where the slices begin, and per slice
  float borderLength;
  int slicesClosed;                   // 1 if the last slice neighbours the first
  int sliceCount, samplesPerSlice;
  int rowLength, treeLevels;          // texels of a row, levels of its tree or 0: none
  float breakThreshold;               // relative change of distance that is a break,
  float endThreshold;                 // as a difference of end coordinates (lib/stored.glsl)
  float bendThreshold;                // bend of the inscatter that is refined
  float leastWeight;                  // bilateral
  float spreadThreshold;              // spread of the samples around a pixel, as a part of the picture's mean, over which it is marched by itself
  float averageThreshold;             // optical depth of a stretch of a row that is taken by its average
  int firstRefreshedSlice;            // temporal reuse: slices that are drawn anew though nothing has changed,
  int endRefreshedSlice;              // up to this one
  float rowCodeScale, rowCodeOffset;  // coded depth of a row = rowCodeScale depth + rowCodeOffset;
  float emptyRowCode;                 // that of a texel without a caster
  float rowCodeSteps;                 // 65535 if it is stored in 16 bit, else 0
  vec3 storedScale;                   // of colours in half floats (lib/stored.glsl)
  float leastCoordinate;              // end coordinate of the lowest code
  int firstView, drawnViews;          // shadow views of a draw
  int bringsOutside;                  // 1 for the draw that brings what is outside all views
  int lowRankTerms;                   // low rank (lib/lowRank.glsl)
  float lowRankRayBegin;              // first coordinate of the grid of camera rays,
  float lowRankRayScale;              // samples a unit
  float lowRankLightBegin;            // the same of light rays,
  float lowRankLightExtent;           // of the whole grid
  int lowRankPerSlice;                // 1 if each slice has factors of its own
  int comparesEnds, comparesRows;     // temporal reuse: what is compared with the last frame's,
  int comparesDepth, comparesSome;    // the depth itself, only some of the slices
  int shownSamples;                   // debug views of samples: 0 all, 1 at depth breaks, 2 march samples
  int keepsEnds;                      // temporal reuse: ends that other jitters saw stay where they may
  float sliceTarget;                  // error, as a part of the picture's mean, for which slices are chosen; 0: all are drawn (lib/slices.glsl),
  int candidateSlices;                // and from how many
  int epipolarPadding0, epipolarPadding1, epipolarPadding2;
};
