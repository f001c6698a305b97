// What Context needs of the window system. Private to host/gl.
#pragma once

#include "gl/Context.h"

#include <array>
#include <utility>

namespace host {

class NativeContext {
public:
  NativeContext() = default;
  virtual ~NativeContext() = default;
  NativeContext(const NativeContext&) = delete;
  NativeContext& operator=(const NativeContext&) = delete;

  virtual void bind() = 0;   ///< throws host::Error
  virtual void unbind() = 0; ///< no context is current afterwards; does not throw
  virtual Context::Loader loader() const = 0;
};

/// Versions in the order in which they are asked for.
inline constexpr std::array<std::pair<int, int>, 4> kCoreVersions = {{{4, 5}, {4, 3}, {4, 1}, {3, 3}}};

/// That of OpenGL ES.
inline constexpr std::pair<int, int> kEmbeddedVersion = {3, 2};

/// Each throws host::Error if the library or a profile of at least 3.3 is missing.
std::unique_ptr<NativeContext> createOsmesaContext(const ContextOptions& options);
std::unique_ptr<NativeContext> createEglContext(const ContextOptions& options);
std::unique_ptr<NativeContext> createGlfwContext(const ContextOptions& options);

} // namespace host
