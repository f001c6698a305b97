// Floor: as many texels as a pass reads, added up: of each texture, WIDTH_i x HEIGHT_i, COUNT_i a fragment, one below the
// other from the place that the fragment has in its target. Writes TARGETS colours, or a colour and a factor to blend.
#define FETCH(image, width, height, count)                                                                             \
  {                                                                                                                    \
    ivec2 at = ivec2(place * vec2(width, height - (count) + 1));                                                       \
    for (int i = 0; i < (count); ++i)                                                                                  \
      sum += texelFetch(image, at + ivec2(0, i), 0);                                                                   \
  }

uniform vec2 scale; // 1 / size of the target
uniform sampler2D read0, read1, read2, read3, read4, read5, read6, read7;
#if COMPOSITE
layout(location = 0, index = 0) out vec4 outFirst;
layout(location = 0, index = 1) out vec4 outFactor;
#else
layout(location = 0) out vec4 outFirst;
#endif
#if TARGETS > 1
layout(location = 1) out vec4 outSecond;
layout(location = 2) out vec4 outThird;
#endif

void main() {
  vec2 place = gl_FragCoord.xy * scale;
  vec4 sum = vec4(0.0);
  FETCH(read0, WIDTH_0, HEIGHT_0, COUNT_0)
  FETCH(read1, WIDTH_1, HEIGHT_1, COUNT_1)
  FETCH(read2, WIDTH_2, HEIGHT_2, COUNT_2)
  FETCH(read3, WIDTH_3, HEIGHT_3, COUNT_3)
  FETCH(read4, WIDTH_4, HEIGHT_4, COUNT_4)
  FETCH(read5, WIDTH_5, HEIGHT_5, COUNT_5)
  FETCH(read6, WIDTH_6, HEIGHT_6, COUNT_6)
  FETCH(read7, WIDTH_7, HEIGHT_7, COUNT_7)
  outFirst = sum;
#if COMPOSITE
  outFactor = sum;
#endif
#if TARGETS > 1
  outSecond = sum;
  outThird = sum;
#endif
}
