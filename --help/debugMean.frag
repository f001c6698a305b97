#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Debug view of mean: mean of each row of a texture over R, G and B, left to right: a second draw over the
uniform sampler2D image;
layout(location = 0) out vec4 outMean;

void main() {
  int row = int(gl_FragCoord.x), width = textureSize(image, 0).x;
  float sum = 0.0;
  for (int x = 0; x < width; ++x) {
    vec3 value = texelFetch(image, ivec2(x, row), 0).rgb;
    float mean = (value.r + value.g + value.b) / 3.0;
    sum += mean >= 0.0 && mean < 3e38 ? mean : 0.0;
  }
  outMean = vec4(sum / float(width));
}
