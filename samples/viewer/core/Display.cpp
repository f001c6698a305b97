#include "Display.h"

#include <gl/Gl.h>
#include <gl/RenderState.h>
#include <utility>

namespace viewer {

namespace {

constexpr const char* kVertex = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
)";

// The curves are those of host::toneMap().
constexpr const char* kFragment = R"(#version 330 core
in vec2 place;
uniform sampler2D first, second, firstLight, secondLight, exact;
uniform float exposure, wipe, exactMean, differenceScale, exactRows;
uniform int tone; // 0 film, 1 Reinhard, 2 clip, 3 numbers
uniform int isDifference;
layout(location = 0) out vec4 shown;

float filmic(float x) { return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0); }

vec3 toneMapped(vec3 radiance) {
  if (any(isnan(radiance))) return vec3(1.0, 0.0, 1.0);
  if (tone == 3) return clamp(radiance, 0.0, 1.0);
  vec3 scaled = clamp(radiance * exposure, 0.0, 1e6);
  float peak = max(scaled.r, max(scaled.g, scaled.b));
  if (tone == 2) return min(scaled, 1.0);
  if (tone == 1) return scaled / (1.0 + peak);
  float mapped = filmic(peak);
  float white = 1.0 - 1.0 / (0.15 * max(peak - mapped, 0.0) + 1.0);
  vec3 pure = peak > 0.0 ? scaled / peak * mapped : vec3(0.0);
  return pure + (mapped - pure) * white;
}

vec3 encoded(vec3 linear) {
  return mix(1.055 * pow(max(linear, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055, 12.92 * linear,
             lessThanEqual(linear, vec3(0.0031308)));
}

// Grey 0, red more, blue less.
vec3 difference(vec3 light) {
  float error = dot(light - texture(exact, place).rgb, vec3(1.0 / 3.0)) / (exactMean * differenceScale);
  float size = min(abs(error), 1.0);
  return mix(vec3(0.5), error > 0.0 ? vec3(1.0, 0.1, 0.0) : vec3(0.0, 0.3, 1.0), size);
}

void main() {
  bool isFirst = place.x < wipe;
  if (isDifference != 0 && place.y < exactRows) {
    shown = vec4(difference(isFirst ? texture(firstLight, place).rgb : texture(secondLight, place).rgb), 1.0);
    return;
  }
  shown = vec4(encoded(toneMapped(isFirst ? texture(first, place).rgb : texture(second, place).rgb)), 1.0);
}
)";

} // namespace

Display::Display()
    : program_("display", kVertex, kFragment), framebuffer_(host::makeFramebuffer()), empty_(host::makeVertexArray()),
      smooth_(host::makeSampler()), exact_(host::makeSampler()) {
  const GladGLContext& gl = host::gl();
  for (const auto& [sampler, filter] : {std::pair{smooth_.name(), GL_LINEAR}, std::pair{exact_.name(), GL_NEAREST}}) {
    gl.SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, filter);
    gl.SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, filter);
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
}

void Display::draw(const Shown& first, const Shown& second, const DisplayOptions& options, int width, int height) {
  const GladGLContext& gl = host::gl();
  if (width != width_ || height != height_) {
    texture_ = host::makeTexture2D(GL_RGBA8, width, height);
    width_ = width;
    height_ = height;
  }
  host::resetRenderState();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  gl.Viewport(0, 0, width, height);
  gl.Disable(GL_DEPTH_TEST);
  program_.use();
  const bool isOfSize =
      first.width == width && first.height == height && second.width == width && second.height == height;
  const GLuint textures[] = {first.composite, second.composite, first.inscatter, second.inscatter, options.exact};
  const char* const names[] = {"first", "second", "firstLight", "secondLight", "exact"};
  for (int unit = 0; unit < 5; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, textures[unit]);
    gl.BindSampler(unit, isOfSize ? exact_.name() : smooth_.name()); // filters round weights
    program_.set(names[unit], unit);
  }
  program_.set("exposure", options.exposure);
  program_.set("wipe", options.wipe);
  program_.set("tone", options.areNumbers ? 3 : static_cast<int>(options.tone));
  program_.set("isDifference", options.exact != 0 ? 1 : 0);
  program_.set("exactMean", options.exactMean);
  program_.set("differenceScale", options.differenceScale);
  program_.set("exactRows", options.exactRows);
  gl.BindVertexArray(empty_.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  for (int unit = 0; unit < 5; ++unit)
    gl.BindSampler(unit, 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace viewer
