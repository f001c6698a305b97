#include "gl/Library.h"
#include "gl/NativeContext.h"
#include "scene/Error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace host {

namespace {

/// The functions of libEGL, and a display without a screen, which contexts share.
struct EglLibrary {
  decltype(&eglGetProcAddress) getProcAddress = nullptr;
  decltype(&eglQueryString) queryString = nullptr;
  decltype(&eglGetDisplay) getDisplay = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bindApi = nullptr;
  decltype(&eglChooseConfig) chooseConfig = nullptr;
  decltype(&eglCreateContext) createContext = nullptr;
  decltype(&eglDestroyContext) destroyContext = nullptr;
  decltype(&eglMakeCurrent) makeCurrent = nullptr;
  EGLDisplay display = EGL_NO_DISPLAY;
};

bool contains(const char* extensions, const std::string& name) {
  return extensions && (std::string(extensions) + " ").find(name + " ") != std::string::npos;
}

bool initialize(EglLibrary& egl, EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !egl.initialize(display, nullptr, nullptr)) {
    return false;
  }
  egl.display = display;
  return true;
}

bool initializeDevice(EglLibrary& egl, PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay) {
  const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.getProcAddress("eglQueryDevicesEXT"));
  constexpr EGLint kMaxDevices = 16;
  EGLDeviceEXT devices[kMaxDevices];
  EGLint count = 0;
  if (!queryDevices || !queryDevices(kMaxDevices, devices, &count)) {
    return false;
  }
  for (EGLint i = 0; i < count; ++i) {
    if (initialize(egl, getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr))) {
      return true;
    }
  }
  return false;
}

void openDisplay(EglLibrary& egl) {
  const char* extensions = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto getPlatformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.getProcAddress("eglGetPlatformDisplayEXT"));
  if (getPlatformDisplay) {
    if (contains(extensions, "EGL_MESA_platform_surfaceless") &&
        initialize(egl, getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr))) {
      return;
    }
    if (contains(extensions, "EGL_EXT_platform_device") && initializeDevice(egl, getPlatformDisplay)) {
      return;
    }
  }
  if (!initialize(egl, egl.getDisplay(EGL_DEFAULT_DISPLAY))) {
    throw Error("context egl: no display, neither surfaceless nor of a device nor the default one");
  }
}

EglLibrary openEgl() {
  const Library library("egl", {"libEGL.so.1"}, "libegl1");
  EglLibrary egl;
  library.resolve("eglGetProcAddress", egl.getProcAddress);
  library.resolve("eglQueryString", egl.queryString);
  library.resolve("eglGetDisplay", egl.getDisplay);
  library.resolve("eglInitialize", egl.initialize);
  library.resolve("eglBindAPI", egl.bindApi);
  library.resolve("eglChooseConfig", egl.chooseConfig);
  library.resolve("eglCreateContext", egl.createContext);
  library.resolve("eglDestroyContext", egl.destroyContext);
  library.resolve("eglMakeCurrent", egl.makeCurrent);
  openDisplay(egl);
  if (!contains(egl.queryString(egl.display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    throw Error("context egl: the display lacks EGL_KHR_surfaceless_context");
  }
  return egl;
}

const EglLibrary& egl() {
  static const EglLibrary library = openEgl();
  return library;
}

void* load(const char* name) { return reinterpret_cast<void*>(egl().getProcAddress(name)); }

class EglContext final : public NativeContext {
public:
  explicit EglContext(bool debug) {
    const EGLint configAttributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl().bindApi(EGL_OPENGL_API) || !egl().chooseConfig(egl().display, configAttributes, &config, 1, &count) ||
        count == 0) {
      throw Error("context egl: the display offers no desktop OpenGL");
    }
    for (const auto& [major, minor] : kCoreVersions) {
      const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   major,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   minor,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_CONTEXT_OPENGL_DEBUG,
                                   debug ? EGL_TRUE : EGL_FALSE,
                                   EGL_NONE};
      context_ = egl().createContext(egl().display, config, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT) {
        return;
      }
    }
    throw Error("context egl: the display has no OpenGL 3.3 core profile");
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
  return std::make_unique<EglContext>(options.debug);
}

} // namespace host
