#include "gl/EglLibrary.h"

#include "gl/Driver.h"
#include "gl/EglDevices.h"
#include "gl/Library.h"
#include "scene/Error.h"
#include "scene/Tool.h"

#include <EGL/eglext.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace host {

namespace {

bool contains(const char* extensions, const std::string& name) {
  return extensions && (" " + std::string(extensions) + " ").find(" " + name + " ") != std::string::npos;
}

/// What EGL offers without a display.
class Client {
public:
  explicit Client(const EglLibrary& egl)
      : egl_(egl), extensions_(egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS)),
        getPlatformDisplay_(resolve<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT")),
        queryString_(resolve<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT")) {
    if (!getPlatformDisplay_ || !contains(extensions_, "EGL_EXT_platform_device")) return;
    const auto queryDevices = resolve<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    constexpr EGLint kMostDevices = 64;
    EGLint count = 0;
    handles_.resize(kMostDevices);
    const bool asked = queryDevices && queryDevices(kMostDevices, handles_.data(), &count);
    handles_.resize(asked ? static_cast<std::size_t>(count) : 0);
  }

  std::vector<EglDevice> devices() const {
    std::vector<EglDevice> all;
    all.reserve(handles_.size());
    for (EGLDeviceEXT handle : handles_)
      all.push_back(describe(handle));
    return all;
  }

  EGLDisplay displayOf(std::size_t device) const {
    return getPlatformDisplay_(EGL_PLATFORM_DEVICE_EXT, handles_[device], nullptr);
  }

  EGLDisplay surfaceless() const {
    return getPlatformDisplay_ && contains(extensions_, "EGL_MESA_platform_surfaceless")
               ? getPlatformDisplay_(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
               : EGL_NO_DISPLAY;
  }

private:
  template <class Function>
  Function resolve(const char* name) const {
    return reinterpret_cast<Function>(egl_.getProcAddress(name));
  }

  EglDevice describe(EGLDeviceEXT handle) const {
    EglDevice device;
    const char* extensions = queryString_ ? queryString_(handle, EGL_EXTENSIONS) : nullptr;
    device.isSoftware = contains(extensions, "EGL_MESA_device_software");
    const auto add = [&](const char* extension, EGLint name) {
      const char* text = contains(extensions, extension) ? queryString_(handle, name) : nullptr;
      if (text && *text) device.name += (device.name.empty() ? "" : ", ") + std::string(text);
    };
    if (device.isSoftware) device.name = "software";
    add("EGL_EXT_device_query_name", EGL_RENDERER_EXT);
    add("EGL_EXT_device_query_name", EGL_VENDOR);
    if (contains(extensions, "EGL_NV_device_cuda") && device.name.find("NVIDIA") == std::string::npos)
      device.name += device.name.empty() ? "NVIDIA" : ", NVIDIA";
    add("EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT);
    if (device.name.empty()) device.name = "unnamed";
    return device;
  }

  const EglLibrary& egl_;
  const char* extensions_;
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay_;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryString_;
  std::vector<EGLDeviceEXT> handles_;
};

/// The first of several displays that gives contexts of desktop OpenGL without a surface.
class DisplayChoice {
public:
  explicit DisplayChoice(EglLibrary& egl) : egl_(egl) {}

  bool take(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !egl_.initialize(display, nullptr, nullptr))
      return reject("cannot be initialised");
    if (!contains(egl_.queryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
      return rejectOpen(display, "lacks EGL_KHR_surfaceless_context");
    const EGLint attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (!egl_.bindApi(EGL_OPENGL_API) || !egl_.chooseConfig(display, attributes, &egl_.config, 1, &count) || count == 0)
      return rejectOpen(display, "offers no desktop OpenGL");
    egl_.display = display;
    return true;
  }

  /// The same, unless the driver turns out to be software: a device without 3D has one.
  bool takeGpu(EGLDisplay display) {
    if (!take(display)) return false;
    const std::string renderer = rendererOf(display);
    if (renderer.empty()) return rejectOpen(display, "gives no context of OpenGL 3.3");
    if (host::isSoftware(renderer)) return rejectOpen(display, "draws in software");
    return true;
  }

  const std::string& reason() const { return reason_; } ///< against the last display

private:
  std::string rendererOf(EGLDisplay display) const {
    constexpr unsigned kRenderer = 0x1F01; // GL_RENDERER
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    EGLContext context = egl_.createContext(display, egl_.config, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) return {};
    const auto getString = reinterpret_cast<const unsigned char* (*)(unsigned)>(egl_.getProcAddress("glGetString"));
    std::string renderer;
    if (getString && egl_.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      const unsigned char* text = getString(kRenderer);
      renderer = text ? reinterpret_cast<const char*>(text) : "";
      egl_.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    egl_.destroyContext(display, context);
    return renderer;
  }
  bool reject(const char* reason) {
    reason_ = reason;
    return false;
  }
  bool rejectOpen(EGLDisplay display, const char* reason) {
    egl_.terminate(display);
    return reject(reason);
  }

  EglLibrary& egl_;
  std::string reason_;
};

EglLibrary loadFunctions() {
  const Library library("egl", {"libEGL.so.1"}, "libegl1");
  EglLibrary egl;
  library.resolve("eglGetProcAddress", egl.getProcAddress);
  library.resolve("eglQueryString", egl.queryString);
  library.resolve("eglGetDisplay", egl.getDisplay);
  library.resolve("eglInitialize", egl.initialize);
  library.resolve("eglTerminate", egl.terminate);
  library.resolve("eglBindAPI", egl.bindApi);
  library.resolve("eglChooseConfig", egl.chooseConfig);
  library.resolve("eglCreateContext", egl.createContext);
  library.resolve("eglDestroyContext", egl.destroyContext);
  library.resolve("eglMakeCurrent", egl.makeCurrent);
  return egl;
}

struct OpenedEgl {
  EglLibrary library = loadFunctions();
  std::string displayName;

  OpenedEgl() {
    const Client client(library);
    const char* wanted = std::getenv(kEglDeviceVariable);
    if (!openDevice(client, wanted ? wanted : "") && !openOther(client))
      throw Error("context egl: no display, neither of a device nor surfaceless nor the default one: the last one " +
                  choice_.reason());
  }

private:
  bool openDevice(const Client& client, const std::string& wanted) {
    const std::vector<EglDevice> devices = client.devices();
    for (const std::size_t i : devicesToTry(devices, wanted)) {
      const std::string name = nameOf(i, devices);
      if (open(client.displayOf(i), name, wanted.empty())) return true;
      std::string fault = "context egl: ";
      if (!wanted.empty()) fault += std::string(kEglDeviceVariable) + "=" + wanted + ": ";
      fault += name + " " + choice_.reason();
      if (!wanted.empty()) throw Error(fault);
      say(fault);
    }
    return false;
  }

  bool openOther(const Client& client) {
    return open(client.surfaceless(), "surfaceless") || openSoftware(client) ||
           open(library.getDisplay(EGL_DEFAULT_DISPLAY), "default display");
  }

  bool openSoftware(const Client& client) {
    const std::vector<EglDevice> devices = client.devices();
    for (std::size_t i = 0; i < devices.size(); ++i)
      if (devices[i].isSoftware && open(client.displayOf(i), nameOf(i, devices))) return true;
    return false;
  }

  static std::string nameOf(std::size_t i, const std::vector<EglDevice>& devices) {
    return "device " + std::to_string(i) + ": " + devices[i].name;
  }

  bool open(EGLDisplay display, const std::string& name, bool asGpu = false) {
    if (!(asGpu ? choice_.takeGpu(display) : choice_.take(display))) return false;
    displayName = name;
    return true;
  }

  DisplayChoice choice_{library};
};

const OpenedEgl& openedEgl() {
  static const OpenedEgl opened;
  return opened;
}

} // namespace

const EglLibrary& egl() { return openedEgl().library; }

std::string eglDisplayInUse() { return openedEgl().displayName; }

std::vector<EglDevice> eglDevices() {
  const EglLibrary library = loadFunctions();
  return Client(library).devices();
}

std::string listOf(const std::vector<EglDevice>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + ": " + devices[i].name;
  return text.empty() ? "none" : text;
}

std::vector<std::size_t> devicesToTry(const std::vector<EglDevice>& devices, const std::string& wanted) {
  std::vector<std::size_t> chosen;
  std::size_t number = 0;
  const auto [rest, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  const bool isNumber = error == std::errc() && rest == wanted.data() + wanted.size();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const bool isNamed = isNumber ? i == number : devices[i].name.find(wanted) != std::string::npos;
    if (wanted.empty() ? !devices[i].isSoftware : isNamed) chosen.push_back(i);
  }
  if (wanted.empty()) return chosen;
  if (chosen.empty())
    throw Error(std::string("context egl: ") + kEglDeviceVariable + "=" + wanted +
                ": must be the number or a part of the name of one of EGL's devices: " + listOf(devices));
  return {chosen.front()};
}

} // namespace host
