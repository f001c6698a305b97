#include "ShaftsLookup.h"

#include <cmath>
#include <gl/ReadBack.h>
#include <string>

namespace tests {

using host::gl;

namespace {

const char* const kVertex = R"(#version 330 core
void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); })";

std::string fragmentText() {
  return std::string("#version 330 core\n") + tyndall::shaftsLookupSource() + R"(
uniform float distanceHere;
layout(location = 0) out vec4 inscatter;
layout(location = 1) out vec4 transmittance;
void main() {
  TyndallShafts shafts = tyndallShafts(gl_FragCoord.xy, distanceHere);
  inscatter = vec4(shafts.inscatter, 1.0);
  transmittance = vec4(shafts.transmittance, 1.0);
})";
}

// What no draw has written stands out.
host::GlTexture layers(GLenum format, int width, int height, int count) {
  host::GlTexture texture = host::makeTextureArray(format, width, height, count);
  const std::vector<float> values(static_cast<std::size_t>(4 * width * height * count), 7);
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  gl().TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, width, height, count, GL_RGBA, GL_FLOAT, values.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl().TexParameteri(GL_TEXTURE_2D_ARRAY, filter, GL_LINEAR);
  return texture;
}

} // namespace

ShaftsLookup::ShaftsLookup(int columns, int rows, int layerCount, const Range& distances, GLenum format)
    : width_(columns), height_(rows), depths_(layerCount), range_(distances),
      inscatter_(layers(format, columns, rows, layerCount)), transmittance_(layers(format, columns, rows, layerCount)) {
}

void ShaftsLookup::enter(tyndall::Frame& frame) const {
  frame.lookup = {inscatter_.name(), transmittance_.name(), range_.near, range_.far};
}

double ShaftsLookup::distance(int layer) const {
  return range_.near * std::pow(range_.far / range_.near, layer / (depths_ - 1.0));
}

reference::Image ShaftsLookup::light(int layer) const {
  return {width_, height_, host::readColourArray(inscatter_.name(), width_, height_, layer, 3)};
}

reference::Image ShaftsLookup::passed(int layer) const {
  return {width_, height_, host::readColourArray(transmittance_.name(), width_, height_, layer, 3)};
}

reference::ImageAnswer ShaftsLookup::at(double distance, int viewportWidth, int viewportHeight) const {
  host::Program program("look-up", kVertex, fragmentText().c_str());
  const host::GlTexture light = host::makeTexture2D(GL_RGBA32F, viewportWidth, viewportHeight),
                        left = host::makeTexture2D(GL_RGBA32F, viewportWidth, viewportHeight);
  const host::GlFramebuffer target = host::makeFramebuffer();
  gl().BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, light.name(), 0);
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, left.name(), 0);
  const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  gl().DrawBuffers(2, buffers);
  gl().Viewport(0, 0, viewportWidth, viewportHeight);
  gl().Disable(GL_BLEND);
  const host::GlVertexArray vertices = host::makeVertexArray();
  gl().BindVertexArray(vertices.name());
  program.use();
  program.set("tyndallViewport", glm::vec4(0, 0, viewportWidth, viewportHeight));
  program.set("tyndallDistances", glm::vec2(range_.near, range_.far));
  program.set("distanceHere", static_cast<float>(distance));
  program.set("tyndallInscatter", 0);
  program.set("tyndallTransmittance", 1);
  gl().ActiveTexture(GL_TEXTURE1);
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, transmittance_.name());
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, inscatter_.name());
  gl().DrawArrays(GL_TRIANGLES, 0, 3);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  return {{viewportWidth, viewportHeight, host::readColour(light.name(), viewportWidth, viewportHeight, 3)},
          {viewportWidth, viewportHeight, host::readColour(left.name(), viewportWidth, viewportHeight, 3)}};
}

} // namespace tests
