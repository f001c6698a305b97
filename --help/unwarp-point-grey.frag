#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define LIGHT_KIND 1
#define GLASS 0
#define MONOCHROME 1
#define COMPOSITE 0
#define SPREAD 0
// Unwarp: from slices to pixels, bilinear over two slices and two samples each, each sample weighted by how well its

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


#if MONOCHROME
#define Spectrum float
#define SPECTRUM(v) (v).x
#else
#define Spectrum vec3
#define SPECTRUM(v) (v).rgb
#endif

vec3 transmittanceTo(float s) { return vec3(exp(-SPECTRUM(extinction) * s)); }

Spectrum phaseTowardsEye(float oneMinusCos, float onePlusCos) {
  float cosSquared = 0.25 * (onePlusCos - oneMinusCos) * (onePlusCos - oneMinusCos);
  Spectrum sum = Spectrum(0.0);
  for (int k = 0; k < constituentCount; ++k) {
    vec4 shape = phaseShape[k];
    float d = shape.x + shape.y * (shape.w > 0.0 ? oneMinusCos : onePlusCos);
    float r = inversesqrt(d);
    sum += SPECTRUM(phaseWeight[k]) * ((1.0 + shape.z * cosSquared) * (r * r * r));
  }
  return sum;
}

Spectrum phaseAlong(Ray ray) {
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  return phaseTowardsEye(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
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

#define Light vec3

float lampSine(Ray ray) {
#if LIGHT_KIND == 0
  return 1.0;
#else
  if (epipoleSign < 0.0) return 1.0; // behind the camera the inscatter stays finite
  vec3 toLight = lightPosition - ray.origin, normal = cross(toLight, ray.direction);
  float square = dot(toLight, toLight);
  return square > 0.0 ? sqrt(max(dot(normal, normal) / square, 1e-13)) : 1.0; // the floor of airlightOf
#endif
}

vec3 storedLight(Light light, Ray ray) {
#if MONOCHROME && !GLASS
  return vec3(light) * lampSine(ray);
#else
  return min(storedScale * vec3(light) * lampSine(ray), vec3(65504.0));
#endif
}

float endCoordinate(Ray ray, float end) {
  float coordinate = log2(max(end, 1e-30));
#if LIGHT_KIND != 0
  vec3 toLight = lightPosition - ray.origin;
  coordinate += atan(end - dot(toLight, ray.direction), max(length(cross(toLight, ray.direction)), 1e-30));
#endif
  return coordinate;
}

const float kCoordinateSteps = 1280.0; // of a unit
const int kHalfLeast = 113 << 10, kHalfCount = 30 << 10; // bits of the normal half floats as a float has them, >> 13

float halfOfCoordinate(float coordinate) {
  int code = int(clamp((coordinate - leastCoordinate) * kCoordinateSteps + 0.5, 0.0, float(2 * kHalfCount - 1)));
  float size = intBitsToFloat((kHalfLeast + code % kHalfCount) << 13);
  return code < kHalfCount ? -size : size;
}

float coordinateOfHalf(float value) {
  int code = (floatBitsToInt(abs(value)) >> 13) - kHalfLeast + (value < 0.0 ? 0 : kHalfCount);
  return float(code) / kCoordinateSteps + leastCoordinate;
}

vec4 storedWithCoordinate(vec3 light, float coordinate) {
#if MONOCHROME && !GLASS
  return vec4(light.r, coordinate, 0.0, 0.0);
#else
  return vec4(light, halfOfCoordinate(coordinate));
#endif
}

float storedCoordinate(vec4 texel) {
#if MONOCHROME && !GLASS
  return texel.g;
#else
  return coordinateOfHalf(texel.a);
#endif
}


vec3 lightOf(vec3 texel) {
#if MONOCHROME && !GLASS
  return texel.rrr;
#else
  return texel / storedScale;
#endif
}

vec3 radianceUnit(Ray ray) {
#if LIGHT_KIND == 0
  return lightColour * vec3(phaseAlong(ray));
#else
  return lightColour / lampSine(ray);
#endif
}

float brightestOf(vec3 light) { return max(light.r, max(light.g, light.b)); }


uniform sampler2D epipolarInscatter;
#if SPREAD
uniform sampler2D meanLight;
vec3 spreadUnit; // radiance of a unit of stored light at this pixel, as a part of the picture's mean
#endif

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

struct Sums {
  vec4 agreeing, plain;
  float plainWeight, squares;
};

void addSlice(int slice, float sliceWeight, vec2 p, float end, inout Sums sums) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  float y = dot(p, line.xy) + line.z, beyond = max(max(-y, y - line.w), 0.0);
  if (beyond * beyond > dot(line.xy, line.xy)) return; // by more than a pixel: the slice does not come as far
  y = clamp(y, 0.0, line.w);
  int low = min(int(y), max(int(line.w) - 1, 0));
  float f = y - float(low);
  for (int k = 0; k < 2; ++k) {
    vec4 texel = texelFetch(epipolarInscatter, ivec2(slice, low + k), 0);
    float weight = sliceWeight * (k == 0 ? 1.0 - f : f), sampleEnd = storedCoordinate(texel);
    float agreement = min(1.0, endThreshold / max(abs(sampleEnd - end), 1e-20));
    agreement *= agreement;
    float agreeing = weight * agreement * agreement;
    sums.agreeing += agreeing * vec4(texel.rgb, 1.0);
#if SPREAD
    float brightest = brightestOf(lightOf(texel.rgb) * spreadUnit);
    sums.squares += agreeing * brightest * brightest;
#endif
    sums.plain += weight * vec4(texel.rgb, sampleEnd);
    sums.plainWeight += weight;
  }
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(pixel)), 0.0);
  float place = sliceCoordinate(gl_FragCoord.xy), f = fract(place);
  ivec2 slices = neighbourSlices(place);
  Ray ray = cameraRay(gl_FragCoord.xy);
  float coordinate = endCoordinate(ray, min(end, visibleEnd));
#if SPREAD
  spreadUnit = radianceUnit(ray) / max(texelFetch(meanLight, ivec2(0), 0).r, 1e-37);
#endif
  Sums sums = Sums(vec4(0.0), vec4(0.0), 0.0, 0.0);
  addSlice(slices.x, 1.0 - f, gl_FragCoord.xy, coordinate, sums);
  addSlice(slices.y, f, gl_FragCoord.xy, coordinate, sums);
  float apart = abs(sums.plain.a - coordinate * sums.plainWeight), allowed = 0.125 * endThreshold * sums.plainWeight;
  float oneSurface = clamp(2.0 - apart / max(allowed, 1e-20), 0.0, 1.0);
  vec4 sum = mix(sums.agreeing, vec4(sums.plain.rgb, sums.plainWeight), oneSurface);
  const float kNear = LIGHT_KIND == 0 ? EPIPOLE_GAP : LAMP_PIXELS;
  vec2 fromEpipole = gl_FragCoord.xy * epipole.z - epipole.xy;
  float near = (epipole.z > 0.0 ? kNear : EPIPOLE_GAP) * epipole.z;
  if (dot(fromEpipole, fromEpipole) < near * near) discard;
  if (!(sum.w >= leastWeight && sum.w > 0.0)) discard;
#if SPREAD
  float least = spreadThreshold * sums.agreeing.w, brightest = brightestOf(lightOf(sums.agreeing.rgb) * spreadUnit);
  if (sums.squares * sums.agreeing.w - brightest * brightest > least * least) discard;
#endif
  outInscatter = vec4(min(radianceUnit(ray) * lightOf(sum.rgb / sum.w), vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(end), 1.0);
}
