// The functions of libEGL, and the one display that all its contexts share. Private to host/gl.
#pragma once

#include <EGL/egl.h>

namespace host {

struct EglLibrary {
  decltype(&eglGetProcAddress) getProcAddress = nullptr;
  decltype(&eglQueryString) queryString = nullptr;
  decltype(&eglGetDisplay) getDisplay = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglTerminate) terminate = nullptr;
  decltype(&eglBindAPI) bindApi = nullptr;
  decltype(&eglChooseConfig) chooseConfig = nullptr;
  decltype(&eglCreateContext) createContext = nullptr;
  decltype(&eglDestroyContext) destroyContext = nullptr;
  decltype(&eglMakeCurrent) makeCurrent = nullptr;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = nullptr; ///< of desktop OpenGL, for contexts without a surface
};

/// Opened when first asked for. Throws host::Error if the library is missing or gives no display that will do.
const EglLibrary& egl();

} // namespace host
