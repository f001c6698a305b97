#include "gl/ReadBack.h"

#include "gl/Objects.h"
#include "scene/Error.h"

namespace host {

namespace {

constexpr int kNoLayer = -1; ///< a GL_TEXTURE_2D

GLenum formatOf(int channels) {
  constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  if (channels < 1 || channels > 4) {
    throw Error("read-back of " + std::to_string(channels) + " channels: must be 1 to 4");
  }
  return kFormats[channels - 1];
}

void attach(GLenum attachment, GLuint texture, int layer) {
  if (layer == kNoLayer) {
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
  } else {
    gl().FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture, 0, layer);
  }
}

void setPlainPacking() {
  gl().BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (!isEmbedded()) gl().PixelStorei(GL_PACK_SWAP_BYTES, GL_FALSE);
  gl().PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl().PixelStorei(GL_PACK_ROW_LENGTH, 0);
  gl().PixelStorei(GL_PACK_SKIP_ROWS, 0);
  gl().PixelStorei(GL_PACK_SKIP_PIXELS, 0);
}

std::vector<float> read(GLuint texture, int width, int height, int layer, GLenum attachment, GLenum format,
                        int channels) {
  const GlFramebuffer framebuffer = makeFramebuffer();
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  attach(attachment, texture, layer);
  const GLenum buffer = attachment == GL_COLOR_ATTACHMENT0 ? GL_COLOR_ATTACHMENT0 : GL_NONE;
  gl().DrawBuffers(1, &buffer);
  gl().ReadBuffer(buffer);
  requireCompleteFramebuffer("read-back of texture " + std::to_string(texture));
  setPlainPacking();
  if (!isEmbedded()) {
    gl().ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
  }
  std::vector<float> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(channels));
  gl().ReadPixels(0, 0, width, height, format, GL_FLOAT, pixels.data());
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  return pixels;
}

/// OpenGL ES gives no fewer than four.
std::vector<float> firstChannels(const std::vector<float>& rgba, int channels) {
  std::vector<float> values;
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (static_cast<int>(i % 4) < channels) values.push_back(rgba[i]);
  return values;
}

} // namespace

std::vector<float> readColour(GLuint texture, int width, int height, int channels) {
  if (isEmbedded() && channels < 4) return firstChannels(readColour(texture, width, height), channels);
  return read(texture, width, height, kNoLayer, GL_COLOR_ATTACHMENT0, formatOf(channels), channels);
}

std::vector<float> readColourArray(GLuint texture, int width, int height, int layer, int channels) {
  return read(texture, width, height, layer, GL_COLOR_ATTACHMENT0, formatOf(channels), channels);
}

std::vector<float> readDepth(GLuint texture, int width, int height) {
  return read(texture, width, height, kNoLayer, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT, 1);
}

std::vector<float> readDepthArray(GLuint texture, int width, int height, int layer) {
  return read(texture, width, height, layer, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT, 1);
}

} // namespace host
