// A list of texels that shaders read by index.
#pragma once

#include "gl/Objects.h"

namespace host {

class BufferTexture {
public:
  explicit BufferTexture(GLenum format) : buffer_(makeBuffer()), texture_(makeTexture()), format_(format) {}

  /// Replaces the texels, each of which takes texelBytes. Throws host::Error where the context takes fewer; `what`
  /// names them.
  void upload(const void* texels, std::size_t count, std::size_t texelBytes, const char* what);

  void bind(GLuint unit) const;

private:
  GlBuffer buffer_;
  GlTexture texture_;
  GLenum format_;
};

} // namespace host
