#include "gl/EglLibrary.h"
#include "gl/NativeContext.h"
#include "scene/Error.h"

#include <EGL/eglext.h>
#include <vector>

namespace host {

namespace {

void* load(const char* name) { return reinterpret_cast<void*>(egl().getProcAddress(name)); }

class EglContext final : public NativeContext {
public:
  explicit EglContext(const ContextOptions& options)
      : api_(options.profile == ContextProfile::Embedded ? EGL_OPENGL_ES_API : EGL_OPENGL_API) {
    egl().bindApi(api_); // of this thread
    if (api_ == EGL_OPENGL_ES_API) {
      const auto [major, minor] = kEmbeddedVersion;
      if (!create(embeddedConfig(), {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor,
                                     EGL_CONTEXT_OPENGL_DEBUG, options.debug, EGL_NONE}))
        throw Error("context egl: the display has no OpenGL ES 3.2");
      return;
    }
    const EGLint profile = options.profile == ContextProfile::Core ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT
                                                                   : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT;
    for (const auto& [major, minor] : kCoreVersions)
      if (create(egl().config,
                 {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                  profile, EGL_CONTEXT_OPENGL_DEBUG, options.debug, EGL_NONE}))
        return;
    throw Error("context egl: the display has no OpenGL 3.3 of this profile");
  }
  ~EglContext() override { egl().destroyContext(egl().display, context_); }

  void bind() override {
    egl().bindApi(api_);
    if (!egl().makeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      throw Error("context egl: cannot be made current");
    }
  }
  void unbind() override {
    egl().bindApi(api_);
    egl().makeCurrent(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  Context::Loader loader() const override { return load; }

private:
  bool create(EGLConfig config, const std::vector<EGLint>& attributes) {
    context_ = egl().createContext(egl().display, config, EGL_NO_CONTEXT, attributes.data());
    return context_ != EGL_NO_CONTEXT;
  }

  static EGLConfig embeddedConfig() {
    const EGLint attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl().chooseConfig(egl().display, attributes, &config, 1, &count) || count == 0)
      throw Error("context egl: the display has no OpenGL ES 3");
    return config;
  }

  EGLenum api_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<NativeContext> createEglContext(const ContextOptions& options) {
  return std::make_unique<EglContext>(options);
}

} // namespace host
