#include "gl/NativeContext.h"
#include "scene/Error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace host {

namespace {

std::string lastError() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description ? description : "no reason given";
}

/// GLFW is initialised once, with the first window, and ends with the process.
struct GlfwLibrary {
  GlfwLibrary() {
    if (!glfwInit()) {
      throw Error("context glfw: GLFW cannot start: " + lastError());
    }
  }
  ~GlfwLibrary() { glfwTerminate(); }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

void* load(const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

class GlfwContext final : public NativeContext {
public:
  explicit GlfwContext(const ContextOptions& options) {
    if (options.profile == ContextProfile::Embedded) throw Error("context glfw: has no OpenGL ES: use egl");
    static const GlfwLibrary library;
    for (const auto& [major, minor] : kCoreVersions) {
      glfwDefaultWindowHints();
      glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
      glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
      glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
      glfwWindowHint(GLFW_OPENGL_PROFILE,
                     options.profile == ContextProfile::Core ? GLFW_OPENGL_CORE_PROFILE : GLFW_OPENGL_COMPAT_PROFILE);
      glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
      window_ = glfwCreateWindow(kWindowSide, kWindowSide, "tyndall", nullptr, nullptr);
      if (window_) {
        return;
      }
    }
    throw Error("context glfw: no window with an OpenGL 3.3 of this profile: " + lastError());
  }
  ~GlfwContext() override { glfwDestroyWindow(window_); }

  void bind() override {
    glfwMakeContextCurrent(window_);
    if (glfwGetCurrentContext() != window_) {
      throw Error("context glfw: cannot be made current: " + lastError());
    }
  }
  void unbind() override { glfwMakeContextCurrent(nullptr); }
  Context::Loader loader() const override { return load; }

private:
  static constexpr int kWindowSide = 16; ///< pixels of the hidden window, which nothing draws to
  GLFWwindow* window_ = nullptr;
};

} // namespace

std::unique_ptr<NativeContext> createGlfwContext(const ContextOptions& options) {
  return std::make_unique<GlfwContext>(options);
}

} // namespace host
