// From epipolar samples to a pixel: bilinear over two lines and two samples each, weighted by how well distances agree.
// Needs common/epipolar and common/agreement.
uniform sampler2D sampleEnds;
uniform sampler2D sampleInscatter;

// rgb: weighted inscatter, a: sum of weights.
vec4 unwarped(vec2 p, float end) {
  float coordinate = lineCoordinate(p), share = coordinate - floor(coordinate);
  ivec2 around = linesAround(coordinate);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    int line = i < 2 ? around.x : around.y;
    vec4 ends = texelFetch(lines, ivec2(line, 0), 0);
    vec2 along = ends.zw - ends.xy;
    float y = clamp(dot(p - ends.xy, along) / max(dot(along, along), 1e-12), 0.0, 1.0) * float(int(gridSize.y) - 1);
    int low = min(int(y), int(gridSize.y) - 2);
    float f = y - float(low);
#ifdef LINES_ARE_ROWS
    ivec2 at = ivec2(low + (i & 1), line);
#else
    ivec2 at = ivec2(line, low + (i & 1));
#endif
    float weight = (i < 2 ? 1.0 - share : share) * ((i & 1) == 0 ? 1.0 - f : f);
    weight *= agreementOf(comparableEnd(texelFetch(sampleEnds, at, 0).r), comparableEnd(end));
    sum += weight * vec4(texelFetch(sampleInscatter, at, 0).rgb, 1.0);
  }
  return sum;
}
