#include "gl/NativeContext.h"
#include "scene/Error.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

namespace host {

namespace {

/// The functions of libOSMesa, which is opened once and stays: drivers do not survive being unloaded.
struct OsmesaLibrary {
  decltype(&OSMesaCreateContextAttribs) createContextAttribs = nullptr;
  decltype(&OSMesaDestroyContext) destroyContext = nullptr;
  decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) getProcAddress = nullptr;
};

template <class Function>
void resolve(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function) {
    throw Error(std::string("context osmesa: libOSMesa lacks ") + name);
  }
}

OsmesaLibrary openOsmesa() {
  void* handle = nullptr;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (handle) {
      break;
    }
  }
  if (!handle) {
    throw Error("context osmesa: libOSMesa.so.8 cannot be opened; is libosmesa6 installed?");
  }
  OsmesaLibrary library;
  resolve(handle, "OSMesaCreateContextAttribs", library.createContextAttribs);
  resolve(handle, "OSMesaDestroyContext", library.destroyContext);
  resolve(handle, "OSMesaMakeCurrent", library.makeCurrent);
  resolve(handle, "OSMesaGetProcAddress", library.getProcAddress);
  return library;
}

const OsmesaLibrary& osmesa() {
  static const OsmesaLibrary library = openOsmesa();
  return library;
}

void* load(const char* name) { return reinterpret_cast<void*>(osmesa().getProcAddress(name)); }

class OsmesaContext final : public NativeContext {
public:
  OsmesaContext() {
    for (const auto& [major, minor] : kCoreVersions) {
      const int attributes[] = {OSMESA_FORMAT,
                                OSMESA_RGBA,
                                OSMESA_PROFILE,
                                OSMESA_CORE_PROFILE,
                                OSMESA_CONTEXT_MAJOR_VERSION,
                                major,
                                OSMESA_CONTEXT_MINOR_VERSION,
                                minor,
                                0};
      context_ = osmesa().createContextAttribs(attributes, nullptr);
      if (context_) {
        return;
      }
    }
    throw Error("context osmesa: libOSMesa has no OpenGL 3.3 core profile");
  }
  ~OsmesaContext() override { osmesa().destroyContext(context_); }

  void bind() override {
    if (!osmesa().makeCurrent(context_, buffer_, GL_UNSIGNED_BYTE, kBufferSide, kBufferSide)) {
      throw Error("context osmesa: cannot be made current");
    }
  }
  void unbind() override { osmesa().makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  Context::Loader loader() const override { return load; }

private:
  static constexpr int kBufferSide = 4; ///< pixels of the default framebuffer, which nothing draws to
  OSMesaContext context_ = nullptr;
  unsigned char buffer_[4 * kBufferSide * kBufferSide] = {};
};

} // namespace

std::unique_ptr<NativeContext> createOsmesaContext(const ContextOptions& /*options*/) {
  return std::make_unique<OsmesaContext>();
}

} // namespace host
