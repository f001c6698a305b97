// Tint sums: the light that glass lets through to a stretch of a row behind it, as differences of prefix sums of each
// low-rank term times the tint (Chen 2011, 3.4). Sums are taken at groups of four texels; a texture holds the rows of a draw once for
// every four terms, above one another, one texture a channel. Needs lib/lowRank.glsl.

uniform sampler2D tintRed;
uniform sampler2D tintGreen;
uniform sampler2D tintBlue;

vec4 sumsBetween(sampler2D sums, int from, int to, int y) {
  vec4 before = from > 0 ? texelFetch(sums, ivec2(from - 1, y), 0) : vec4(0.0);
  return texelFetch(sums, ivec2(to - 1, y), 0) - before;
}

// Light of the texels from one index to another, multiples of four, all behind panes and before casters.
Light tintedLight(int row, int from, int to) {
  int fours = (lowRankTerms + 3) / 4, rows = textureSize(tintRed, 0).y / fours;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < fours; ++i) {
    int first = 4 * i, y = i * rows + row; // a texture's terms beyond the last are 0
    vec3 a = vec3(rayTerm(first)), b = vec3(rayTerm(min(first + 1, lowRankTerms - 1))), c = vec3(rayTerm(min(first + 2, lowRankTerms - 1)));
    vec3 d = vec3(rayTerm(min(first + 3, lowRankTerms - 1)));
    vec4 red = sumsBetween(tintRed, from >> 2, to >> 2, y), green = sumsBetween(tintGreen, from >> 2, to >> 2, y);
    vec4 blue = sumsBetween(tintBlue, from >> 2, to >> 2, y);
    sum += vec3(dot(red, vec4(a.r, b.r, c.r, d.r)), dot(green, vec4(a.g, b.g, c.g, d.g)), dot(blue, vec4(a.b, b.b, c.b, d.b)));
  }
  return vec3(lowRank.factor) * sum;
}
