#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Changed tiles: of 16 x 16 pixels, those of which a pixel may not be what it was in the last frame: its own depth has changed

#define MAX_CONSTITUENTS 4
#define MAX_SHADOW_VIEWS 6
#define MAX_DEPTH_SAMPLES 16
#define EPIPOLE_GAP 0.25 // pixels between an epipole in the image and where slices begin
#define LAMP_PIXELS 32.0 // around a lamp in the image, where every pixel is marched by itself: its light is brightest there

UNIFORM_BLOCK(FrameBlock) {
  vec4 farPoint[3];
  vec4 nearStep;
  float depthOffset, depthScale;      // t = depthOffset + depthScale * depth
  int isOrthographic;
  float skyEnd;                       // ray length for the sky
  vec3 extinction;                    // sigma_t
  float visibleEnd;                   // ray length beyond which nothing visible is added
  vec4 phaseWeight[MAX_CONSTITUENTS]; // share of sigma_k in the scattering of all constituents, rgb, times the norm of p_k
  vec4 phaseShape[MAX_CONSTITUENTS];  // a, b, c, side: p_k ~ (1 + c cos^2) (a + b (1 -+ cos))^(-3/2), - for side > 0
  float lightCeiling;                 // largest radiance that a light may add,
  float colourMax, outputMax;         // that the colour's format holds, the output's
  int isMultisampled;                 // the depth texture
  int constituentCount;
  int depthSampleCount;               // of a pixel
  ivec2 frameSize;                    // of the image, pixels
};

struct MapView {
  mat4 texelFromCamera;               // (x, y, z, 1) to (texel x, texel y, depth, 1) w; depth grows away from the light
  vec4 margin;                        // what lies beyond a side by at most xy + s zw (x, y times w), which is rounding, belongs to the view
  vec4 curveDepth;                    // depth of the curves (lib/curves.glsl) at x: dot(xyz, x) + w, 0 at the near and 1 at the far plane
  float nearDepth, farDepth;          // of the near and the far plane
  float depthSign;                    // of stored depth
  int isOpen;                         // 1 if open beyond the far plane
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
  ivec2 shadowMapSize;                // texels
  vec4 boundary;                      // the light's path in the medium at x is max(0, dot(xyz, x) + w); all 0 if none
  int viewCount;                      // shadow views
  int curvesSize, curvesPacked;       // curves: texels per side of their map, 1 if packed,
  int texelsPerCurve;                 // texels that hold one
  MapView shadowViews[MAX_SHADOW_VIEWS];
};

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
  int epipolarPadding0, epipolarPadding1;
};


struct Ray {
  vec3 origin;    // eye, or the point on the near plane of an orthographic camera
  vec3 direction; // unit
};

Ray cameraRay(vec2 windowPosition) {
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec3 far = farPoint[0].xyz + p.x * farPoint[1].xyz + p.y * farPoint[2].xyz;
  if (isOrthographic != 0) return Ray(far + nearStep.xyz, normalize(-nearStep.xyz));
  return Ray(vec3(0.0), normalize(far));
}

float rayEnd(vec2 windowPosition, float depth) {
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return t <= 0.0 ? skyEnd : -1.0;
  if (isOrthographic != 0) return max(0.0, 1.0 - t) * length(nearStep.xyz);
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  return length(far.xyz) / (far.w + t * nearStep.w);
}


uniform sampler2D sceneDepth;

float depthAt(ivec2 pixel) { return texelFetch(sceneDepth, pixel, 0).r; }


uniform sampler2D sliceTable;

vec4 sliceEnds(int slice) { return texelFetch(sliceTable, ivec2(slice, 0), 0); }
int sliceSamples(int slice) { return int(texelFetch(sliceTable, ivec2(slice, 1), 0).w) + 1; }

vec2 samplePosition(vec4 ends, int samples, float index) {
  return mix(ends.xy, ends.zw, index / float(max(samples - 1, 1)));
}

float sliceCoordinate(vec2 p) {
  vec2 d = epipoleSign * (epipole.z * p - epipole.xy);
  vec2 target = mix(border.xy, border.zw, greaterThan(d, vec2(0.0)));
  vec2 steps = mix(vec2(3e38), (target - p) / d, notEqual(d, vec2(0.0)));
  bool throughX = steps.x < steps.y;
  vec2 exit = clamp(p + d * min(min(steps.x, steps.y), 3e37), border.xy, border.zw);
  vec2 size = border.zw - border.xy, local = exit - border.xy;
  float arc = throughX ? (d.x > 0.0 ? size.x + local.y : 2.0 * size.x + size.y + (size.y - local.y))
                       : (d.y > 0.0 ? size.x + size.y + (size.x - local.x) : local.x);
  float along = arc - slicesBegin;
  along += along < 0.0 ? borderLength : 0.0;
  return along / sliceWidth - 0.5;
}

ivec2 neighbourSlices(float coordinate) {
  int low = int(floor(coordinate)), last = sliceCount - 1;
  if (slicesClosed != 0) return ivec2((low + sliceCount) % sliceCount, (low + 1 + sliceCount) % sliceCount);
  return clamp(ivec2(low, low + 1), ivec2(0), ivec2(last));
}


const int kTile = 16;

uniform sampler2D changedSegments;
uniform sampler2D changedSlices;
uniform sampler2D sampleEnds;
uniform sampler2D lastDepth;
uniform sampler2D movedSlices;
layout(location = 0) out vec4 outTile;

ivec2 slicesOf(vec2 low, vec2 high) {
  vec2 middle = 0.5 * (low + high);
  if (distance(middle * epipole.z, epipole.xy) < 2.0 * float(kTile) * abs(epipole.z)) return ivec2(0, sliceCount);
  vec4 at = vec4(sliceCoordinate(low), sliceCoordinate(vec2(high.x, low.y)), sliceCoordinate(vec2(low.x, high.y)), sliceCoordinate(high));
  float turn = float(sliceCount), least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  if (slicesClosed != 0 && most - least > 0.5 * turn) { // across the begin
    at += mix(vec4(0.0), vec4(turn), lessThan(at, vec4(0.5 * turn)));
    least = min(min(at.x, at.y), min(at.z, at.w));
    most = max(max(at.x, at.y), max(at.z, at.w));
  }
  int first = int(floor(least));
  return ivec2(first, min(int(floor(most)) + 2 - first, sliceCount));
}

int wrapped(int slice) { return slicesClosed != 0 ? (slice + sliceCount) % sliceCount : clamp(slice, 0, sliceCount - 1); }

float farthestEnd(ivec2 first, ivec2 last) {
  float end = 0.0;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) end = max(end, min(rayEnd(vec2(x, y) + 0.5, depthAt(ivec2(x, y))), visibleEnd));
  return end;
}

vec2 changeOf(int slice, vec2 low, vec2 high) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  vec4 at = line.z + vec4(dot(low, line.xy), dot(vec2(high.x, low.y), line.xy), dot(vec2(low.x, high.y), line.xy), dot(high, line.xy));
  float least = min(min(at.x, at.y), min(at.z, at.w)), most = max(max(at.x, at.y), max(at.z, at.w));
  int first = int(clamp(least, 0.0, line.w)), last = int(clamp(most + 1.0, 0.0, line.w));
  float changed = 0.0, farther = 0.0;
  for (int i = first >> 4; i <= last >> 4; ++i) changed = max(changed, texelFetch(changedSegments, ivec2(slice, i), 0).r);
  if (texelFetch(changedSlices, ivec2(slice, 0), 0).a == 0.0) return vec2(changed, 3e38);
  if (least < 0.0 || most > line.w) return vec2(1.0, 0.0); // beside the slice's samples
  for (int i = first; i <= last; ++i) farther = max(farther, texelFetch(sampleEnds, ivec2(slice, i), 0).r);
  return vec2(changed, 1.0001 * farther);
}

void main() {
  int across = (frameSize.x + kTile - 1) / kTile, tile = int(gl_FragCoord.x) + 256 * int(gl_FragCoord.y);
  ivec2 first = kTile * ivec2(tile % across, tile / across), last = min(first + kTile, frameSize) - 1;
  if (first.y >= frameSize.y) discard;
  vec2 low = vec2(first) + 0.5, high = vec2(last) + 0.5;
  ivec2 slices = slicesOf(low, high);
  bool changed = false, compared = false;
  float alone = 3e38;
  for (int i = 0; i < slices.y && !changed; ++i) {
    int slice = wrapped(slices.x + i);
    if (comparesSome != 0 && texelFetch(movedSlices, ivec2(slice, 0), 0).g == 0.0) continue;
    vec2 change = changeOf(slice, low, high);
    compared = true;
    changed = change.x > 0.0;
    alone = min(alone, change.y);
  }
  for (int y = first.y; comparesDepth != 0 && y <= last.y && compared && !changed; ++y)
    for (int x = first.x; x <= last.x; ++x)
      changed = changed || floatBitsToInt(depthAt(ivec2(x, y))) != floatBitsToInt(texelFetch(lastDepth, ivec2(x, y), 0).r);
  if (!changed && alone < 3e38) changed = farthestEnd(first, last) > alone;
  if (!changed) discard;
  outTile = vec4(1.0);
}
