#include "gl/LightTexture.h"

namespace host {

namespace {

constexpr const char* kWholeViewport = R"(#version 330 core
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
)";

} // namespace

LightTexture::LightTexture(const char* name, const char* fragmentBody, GLenum filter)
    : program_(name, kWholeViewport, fragmentBody), framebuffer_(makeFramebuffer()), empty_(makeVertexArray()),
      filter_(filter) {}

void LightTexture::render(const glm::ivec2& size, const Illumination& illumination, const glm::dvec3& origin,
                          const std::function<void(Program&)>& setUniforms) {
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (size != size_) {
    gl().ActiveTexture(GL_TEXTURE0 + kFirstFreeUnit);
    texture_ = makeTexture2D(GL_RGBA32F, size.x, size.y);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter_));
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter_));
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    requireCompleteFramebuffer("light of smoke and strands");
    size_ = size;
  }
  gl().Viewport(0, 0, size.x, size.y);
  gl().ClearColor(0, 0, 0, 0);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl().Clear(GL_COLOR_BUFFER_BIT);
  gl().Disable(GL_DEPTH_TEST);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE);
  gl().BindVertexArray(empty_.name());
  const auto add = [&](Program& program) {
    setUniforms(program);
    program.set("maxRadiance", illumination.maxRadiance);
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
  };
  Program& ambient = program_.variantFor({});
  ambient.use();
  LightUniforms::setAmbient(ambient, illumination.skyRadiance);
  add(ambient);
  for (const tyndall::Light& light : illumination.lights) {
    Program& program = program_.variantFor(light.curves);
    program.use();
    lights_.set(program, light, origin, illumination.medium);
    add(program);
  }
}

} // namespace host
