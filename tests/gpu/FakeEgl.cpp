// A libEGL.so.1 that lists two devices beside what the system's gives: one without 3D, whose driver draws in software,
// and one that does not open. With FAKE_RENDERER set, the first is a GPU of that name.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <string>

namespace {

template <class Function>
Function real(const char* name) {
  static void* const library = dlopen(TYNDALL_REAL_EGL, RTLD_LAZY | RTLD_LOCAL);
  return reinterpret_cast<Function>(dlsym(library, name));
}

#define FORWARD(name) real<decltype(&(name))>(#name)

EGLDeviceEXT deviceOf(std::size_t number) { return reinterpret_cast<EGLDeviceEXT>(number); } // from 1

EGLBoolean EGLAPIENTRY queryDevices(EGLint most, EGLDeviceEXT* devices, EGLint* count) {
  for (*count = 0; *count < 2 && *count < most; ++*count)
    devices[*count] = deviceOf(static_cast<std::size_t>(*count) + 1);
  return EGL_TRUE;
}

const char* EGLAPIENTRY queryDeviceString(EGLDeviceEXT device, EGLint name) {
  if (name == EGL_EXTENSIONS) return "EGL_EXT_device_drm";
  return device == deviceOf(1) ? "/dev/dri/card0" : "/dev/dri/card1";
}

EGLDisplay EGLAPIENTRY getPlatformDisplay(EGLenum platform, void* native, const EGLint* attributes) {
  const auto get =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(FORWARD(eglGetProcAddress)("eglGetPlatformDisplayEXT"));
  if (platform != EGL_PLATFORM_DEVICE_EXT) return get(platform, native, attributes);
  if (native != deviceOf(1)) return EGL_NO_DISPLAY;
  return get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

const unsigned char* getString(unsigned name) {
  constexpr unsigned kRenderer = 0x1F01;
  const char* fake = std::getenv("FAKE_RENDERER");
  if (fake && name == kRenderer) return reinterpret_cast<const unsigned char*>(fake);
  return reinterpret_cast<const unsigned char* (*)(unsigned)>(FORWARD(eglGetProcAddress)("glGetString"))(name);
}

template <class Function>
__eglMustCastToProperFunctionPointerType addressOf(Function function) {
  return reinterpret_cast<__eglMustCastToProperFunctionPointerType>(function);
}

} // namespace

extern "C" {

__eglMustCastToProperFunctionPointerType EGLAPIENTRY eglGetProcAddress(const char* name) {
  if (std::strcmp(name, "eglQueryDevicesEXT") == 0) return addressOf(queryDevices);
  if (std::strcmp(name, "eglQueryDeviceStringEXT") == 0) return addressOf(queryDeviceString);
  if (std::strcmp(name, "eglGetPlatformDisplayEXT") == 0) return addressOf(getPlatformDisplay);
  if (std::strcmp(name, "glGetString") == 0) return addressOf(getString);
  return FORWARD(eglGetProcAddress)(name);
}

const char* EGLAPIENTRY eglQueryString(EGLDisplay display, EGLint name) {
  const char* text = FORWARD(eglQueryString)(display, name);
  if (display != EGL_NO_DISPLAY || name != EGL_EXTENSIONS) return text;
  static const std::string extensions = std::string(text ? text : "") + " EGL_EXT_platform_device";
  return extensions.c_str();
}

EGLDisplay EGLAPIENTRY eglGetDisplay(EGLNativeDisplayType native) { return FORWARD(eglGetDisplay)(native); }
EGLBoolean EGLAPIENTRY eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
  return FORWARD(eglInitialize)(display, major, minor);
}
EGLBoolean EGLAPIENTRY eglTerminate(EGLDisplay display) { return FORWARD(eglTerminate)(display); }
EGLBoolean EGLAPIENTRY eglBindAPI(EGLenum api) { return FORWARD(eglBindAPI)(api); }
EGLBoolean EGLAPIENTRY eglChooseConfig(EGLDisplay display, const EGLint* attributes, EGLConfig* configs, EGLint size,
                                       EGLint* count) {
  return FORWARD(eglChooseConfig)(display, attributes, configs, size, count);
}
EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                        const EGLint* attributes) {
  return FORWARD(eglCreateContext)(display, config, share, attributes);
}
EGLBoolean EGLAPIENTRY eglDestroyContext(EGLDisplay display, EGLContext context) {
  return FORWARD(eglDestroyContext)(display, context);
}
EGLBoolean EGLAPIENTRY eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
  return FORWARD(eglMakeCurrent)(display, draw, read, context);
}
}
