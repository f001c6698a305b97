#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define SHADOW_VIEWS 2
// Changed segments: those of which a sample may not be what it was in the last frame. Its inscatter follows from the ends and

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

#if SHADOW_VIEWS == 2
int drawnViewOfRow(int y) { return int((float(y) + 0.5) / float(sliceCount)); }
int viewOfRow(int y) { return firstView + drawnViewOfRow(y); }
int sliceOfRow(int y) { return y - sliceCount * drawnViewOfRow(y); }
int rowOf(int view, int slice) { return (view - firstView) * sliceCount + slice; }
#else
int viewOfRow(int y) { return 0; }
int sliceOfRow(int y) { return y; }
int rowOf(int view, int slice) { return slice; }
#endif

vec4 rowLine(int view, int slice) { return texelFetch(sliceTable, ivec2(slice, 2 + 2 * view), 0); }

bool isAlongX(vec4 row) { return abs(row.z) >= abs(row.w); }

int rowLast(int view, int slice) { return max(int(texelFetch(sliceTable, ivec2(slice, 3 + 2 * view), 0).x), 1) - 1; }

int rowTexels(int view, int slice) { return (rowLast(view, slice) | 15) + 1; }


uniform sampler2D sampleEnds;
uniform sampler2D lastSampleEnds;
uniform sampler2D changedEnds;
uniform sampler2D changedParts;
layout(location = 0) out vec4 outChanged;

float endAt(int slice, int i) {
  float end = texelFetch(sampleEnds, ivec2(slice, i), 0).r;
  if (comparesEnds != 0) end = max(end, texelFetch(lastSampleEnds, ivec2(slice, i), 0).r);
  return end;
}

struct ViewRay {
  vec4 begin, direction;
};

ViewRay viewRay(int view, Ray ray) {
  return ViewRay(shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0));
}

float indexAt(ViewRay ray, vec2 along, float origin, float s) {
  vec4 q = ray.begin + s * ray.direction;
  return q.w > 0.0 ? dot(q.xy, along) / q.w - origin : 3e38;
}

bool addCrossing(ViewRay ray, vec2 along, float at, inout vec2 range) {
  float p = at * ray.begin.w - dot(ray.begin.xy, along), q = dot(ray.direction.xy, along) - at * ray.direction.w;
  if (q == 0.0 || p * q < 0.0) return false;
  float s = p / q, w = ray.begin.w + s * ray.direction.w;
  if (!(w > 0.0)) return false;
  float depth = (ray.begin.z + s * ray.direction.z) / w * rowCodeScale + rowCodeOffset;
  range = vec2(min(range.x, depth), max(range.y, depth));
  return true;
}

bool meetsChange(int slice, int samples, int first, int last) {
  vec4 ends = sliceEnds(slice);
  Ray low = cameraRay(samplePosition(ends, samples, float(first))), high = cameraRay(samplePosition(ends, samples, float(last)));
  for (int view = 0; view < drawnViews; ++view) {
    int parts = (rowTexels(view, slice) + 255) / 256;
    bool any = false;
    for (int part = 0; part < parts; ++part) {
      vec2 bounds = texelFetch(changedParts, ivec2(part, rowOf(view, slice)), 0).rg;
      any = any || bounds.x <= bounds.y;
    }
    if (!any) continue;
    vec4 row = rowLine(view, slice);
    vec2 along = row.zw / dot(row.zw, row.zw);
    float origin = dot(row.xy, along), reach = -3e38;
    ViewRay a = viewRay(view, low), b = viewRay(view, high);
    for (int i = first; i <= last; ++i) {
      ViewRay ray = viewRay(view, cameraRay(samplePosition(ends, samples, float(i))));
      reach = max(reach, indexAt(ray, along, origin, max(endAt(slice, i), 0.0)));
    }
    for (int part = 0; part < parts; ++part) {
      vec2 bounds = texelFetch(changedParts, ivec2(part, rowOf(view, slice)), 0).rg;
      float begin = 256.0 * float(part);
      if (bounds.x > bounds.y || reach < begin - 1.0) continue;
      vec2 range = vec2(3e38, -3e38), margin = rowCodeSteps > 0.0 ? vec2(2.0 / rowCodeSteps) : 1e-6 * max(abs(bounds), vec2(1.0)); // of rounding
      bool across = addCrossing(a, along, begin - 1.0 + origin, range) && addCrossing(a, along, begin + 257.0 + origin, range) &&
                    addCrossing(b, along, begin - 1.0 + origin, range) && addCrossing(b, along, begin + 257.0 + origin, range);
      bool before = range.y < bounds.x - margin.x, behind = range.x > bounds.y + margin.y && bounds.y < emptyRowCode;
      if (!across || !(before || behind)) return true;
    }
  }
  return false;
}

void main() {
  int slice = int(gl_FragCoord.x), segment = int(gl_FragCoord.y), samples = sliceSamples(slice);
  int chunk = 64 * (segment >> 2), last = 16 * segment + 48;
  bool changed = slice >= firstRefreshedSlice && slice < endRefreshedSlice;
  for (int i = max(chunk - 18, 0) >> 4; comparesEnds != 0 && i <= min(last + 3, samplesPerSlice - 1) >> 4; ++i)
    changed = changed || texelFetch(changedEnds, ivec2(slice, i), 0).r > 0.0;
  if (comparesRows != 0 && !changed && 16 * segment < samples) changed = meetsChange(slice, samples, max(chunk - 16, 0), min(last, samples - 1));
  if (!changed) discard;
  outChanged = vec4(1.0);
}
