// Names of our objects for GL debuggers and drivers' messages.
#pragma once

#include "gl/Functions.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace tyndall::gl {

/// Names an object of ours "Tyndall ..." where the context can. `kind`: PROGRAM, TEXTURE, BUFFER, ...; a texture or
/// buffer must have been bound before.
inline void label(const Functions& gl, Enum kind, Uint object, std::string_view text) {
  constexpr std::size_t kMost = 255; // GL promises room for no more
  if (!gl.ObjectLabel) return;
  const std::string name = std::string("Tyndall ").append(text);
  gl.ObjectLabel(kind, object, static_cast<Sizei>(std::min(name.size(), kMost)), name.c_str());
}

} // namespace tyndall::gl
