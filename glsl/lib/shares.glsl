// Shares: of a pixel that no sample serves, of a directional light: what the samples around have of the light that there would be without
// shadows, of what the pixel would. Only where it cannot be off by much (below): little is in shadow of what lies between the ends,
// or little is lit. Needs lib/slices.glsl, lib/stored.glsl, lib/fromStored.glsl, lib/openLight.glsl.

uniform sampler2D epipolarInscatter;
uniform sampler2D meanLight;

// By how many targets a pixel may be off, and by what part of the picture's mean: those that unwarp leaves are few, and what they may be
// off by is most often much more than what they are.
const float kTargets = 30.0, kMost = 0.3;

struct Shares {
  vec3 lit;             // parts of the light without shadows, times weights
  float doubt, weights; // what they may be off by, times weights; weights
};

void addShares(int column, float sliceWeight, vec2 p, vec3 open, inout Shares sums) {
  vec4 line = texelFetch(sliceTable, ivec2(column, 1), 0);
  float y = clamp(dot(p, line.xy) + line.z, 0.0, line.w);
  int low = min(int(y), max(int(line.w) - 1, 0));
  for (int k = 0; k < 2; ++k) {
    vec4 texel = texelFetch(epipolarInscatter, ivec2(column, low + k), 0);
    vec3 sampleOpen = openLight(exp2(storedCoordinate(texel)));
    vec3 share = clamp(lightOf(texel.rgb) / max(sampleOpen, vec3(1e-30)), 0.0, 1.0), apart = abs(open - sampleOpen);
    float weight = sliceWeight * max(1.0 - abs(y - float(low + k)), 0.0) / max(brightestOf(apart), 1e-6 * brightestOf(open));
    sums.lit += weight * share;
    sums.doubt += weight * brightestOf(apart * max(share, 1.0 - share));
    sums.weights += weight;
  }
}

// Radiance of the ray up to an end, and 1; or 0 where it is not known.
vec4 radianceByShares(vec2 position, Ray ray, float end) {
  vec3 open = openLight(min(end, visibleEnd)), unit = radianceUnit(ray);
  SlicePair pair = slicesAround(sliceCoordinate(position));
  Shares sums = Shares(vec3(0.0), 0.0, 0.0);
  addShares(pair.columns.x, 1.0 - pair.share, position, open, sums);
  addShares(pair.columns.y, pair.share, position, open, sums);
  float allowed = min(kTargets * sliceTarget, kMost) * texelFetch(meanLight, ivec2(0), 0).r;
  bool isKnown = sums.weights > 0.0 && sums.doubt * brightestOf(unit) < allowed * sums.weights;
  return isKnown ? vec4(unit * open * sums.lit / sums.weights, 1.0) : vec4(0.0);
}
