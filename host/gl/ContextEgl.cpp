#include "gl/EglLibrary.h"
#include "gl/NativeContext.h"
#include "scene/Error.h"

namespace host {

namespace {

void* load(const char* name) { return reinterpret_cast<void*>(egl().getProcAddress(name)); }

class EglContext final : public NativeContext {
public:
  explicit EglContext(const ContextOptions& options) {
    const EGLint profile = options.profile == ContextProfile::Core ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT
                                                                   : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT;
    egl().bindApi(EGL_OPENGL_API); // of this thread
    for (const auto& [major, minor] : kCoreVersions) {
      const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   major,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   minor,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   profile,
                                   EGL_CONTEXT_OPENGL_DEBUG,
                                   options.debug ? EGL_TRUE : EGL_FALSE,
                                   EGL_NONE};
      context_ = egl().createContext(egl().display, egl().config, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT) {
        return;
      }
    }
    throw Error("context egl: the display has no OpenGL 3.3 of this profile");
  }
  ~EglContext() override { egl().destroyContext(egl().display, context_); }

  void bind() override {
    egl().bindApi(EGL_OPENGL_API);
    if (!egl().makeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      throw Error("context egl: cannot be made current");
    }
  }
  void unbind() override { egl().makeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  Context::Loader loader() const override { return load; }

private:
  EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<NativeContext> createEglContext(const ContextOptions& options) {
  return std::make_unique<EglContext>(options);
}

} // namespace host
