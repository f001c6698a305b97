#include "Sheet.h"

#include <algorithm>

namespace stress {

namespace {

GLenum transferOf(GLenum format) {
  switch (format) {
  case GL_R32F:
    return GL_RED;
  case GL_RGB32F:
  case GL_R11F_G11F_B10F:
    return GL_RGB;
  case GL_RGBA16F:
  case GL_RGBA32F:
    return GL_RGBA;
  default:
    return GL_DEPTH_COMPONENT;
  }
}

} // namespace

void Sheet::makeFor(const SheetForm& form) {
  const auto same = [&] {
    return form.format == form_.format && form.width == form_.width && form.height == form_.height &&
           form.layers == form_.layers;
  };
  if (texture_ && same()) return;
  texture_.reset(); // GL may give the name again
  texture_ = form.layers > 0 ? host::makeTextureArray(form.format, form.width, form.height, form.layers)
                             : host::makeTexture2D(form.format, form.width, form.height);
  form_ = form;
  key_ = 0;
}

void Sheet::write(const std::vector<float>& values) {
  const GladGLContext& gl = host::gl();
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (form_.layers > 0) {
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, name());
    gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, form_.width, form_.height, form_.layers, transferOf(form_.format),
                     GL_FLOAT, values.data());
  } else {
    gl.BindTexture(GL_TEXTURE_2D, name());
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, form_.width, form_.height, transferOf(form_.format), GL_FLOAT,
                     values.data());
  }
}

void Sheet::show(const SheetForm& form, std::uint64_t key, const std::function<std::vector<float>()>& draw) {
  makeFor(form);
  if (key == key_) return;
  write(draw());
  key_ = key;
}

void place(std::vector<float>& into, int width, int x, int y, const std::vector<float>& image, int imageWidth,
           int channels) {
  const auto row = static_cast<std::ptrdiff_t>(imageWidth) * channels;
  for (auto from = image.begin(); from != image.end(); from += row, ++y)
    std::copy(from, from + row, into.begin() + (static_cast<std::ptrdiff_t>(y) * width + x) * channels);
}

} // namespace stress
