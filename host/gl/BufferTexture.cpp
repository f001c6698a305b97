#include "gl/BufferTexture.h"

#include "scene/Error.h"

namespace host {

void BufferTexture::upload(const void* texels, std::size_t count, std::size_t texelBytes, const char* what) {
  GLint most = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (count > static_cast<std::size_t>(most)) {
    throw Error(std::string(what) + ": " + std::to_string(count) + " texels must be at most " + std::to_string(most) +
                ", the context's limit for a buffer texture");
  }
  gl().BindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
  gl().BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(count * texelBytes), texels, GL_STREAM_DRAW);
  gl().BindBuffer(GL_TEXTURE_BUFFER, 0);
  gl().BindTexture(GL_TEXTURE_BUFFER, texture_.name());
  gl().TexBuffer(GL_TEXTURE_BUFFER, format_, buffer_.name());
}

void BufferTexture::bind(GLuint unit) const {
  gl().ActiveTexture(GL_TEXTURE0 + unit);
  gl().BindTexture(GL_TEXTURE_BUFFER, texture_.name());
}

} // namespace host
