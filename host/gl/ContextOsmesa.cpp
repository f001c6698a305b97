#include "gl/Library.h"
#include "gl/NativeContext.h"
#include "scene/Error.h"

namespace host {

namespace {

// Of OSMesa's header, which newer Mesas do not have any more.
using OsmesaHandle = struct OsmesaHandleTag*;
constexpr int kFormat = 0x22, kProfile = 0x33, kCoreProfile = 0x34, kCompatibilityProfile = 0x35, kMajorVersion = 0x36,
              kMinorVersion = 0x37;
constexpr int kRgba = 0x1908;              // GL_RGBA
constexpr unsigned kUnsignedByte = 0x1401; // GL_UNSIGNED_BYTE

struct OsmesaLibrary {
  OsmesaHandle (*createContextAttribs)(const int* attributes, OsmesaHandle shared) = nullptr;
  void (*destroyContext)(OsmesaHandle context) = nullptr;
  unsigned char (*makeCurrent)(OsmesaHandle context, void* buffer, unsigned type, int width, int height) = nullptr;
  void (*(*getProcAddress)(const char* name))() = nullptr;
};

OsmesaLibrary openOsmesa() {
  const Library library("osmesa", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "libosmesa6");
  OsmesaLibrary osmesa;
  library.resolve("OSMesaCreateContextAttribs", osmesa.createContextAttribs);
  library.resolve("OSMesaDestroyContext", osmesa.destroyContext);
  library.resolve("OSMesaMakeCurrent", osmesa.makeCurrent);
  library.resolve("OSMesaGetProcAddress", osmesa.getProcAddress);
  return osmesa;
}

const OsmesaLibrary& osmesa() {
  static const OsmesaLibrary library = openOsmesa();
  return library;
}

void* load(const char* name) { return reinterpret_cast<void*>(osmesa().getProcAddress(name)); }

class OsmesaContext final : public NativeContext {
public:
  explicit OsmesaContext(ContextProfile asked) {
    if (asked == ContextProfile::Embedded) throw Error("context osmesa: has no OpenGL ES: use egl");
    const int profile = asked == ContextProfile::Core ? kCoreProfile : kCompatibilityProfile;
    for (const auto& [major, minor] : kCoreVersions) {
      const int attributes[] = {kFormat, kRgba, kProfile, profile, kMajorVersion, major, kMinorVersion, minor, 0};
      context_ = osmesa().createContextAttribs(attributes, nullptr);
      if (context_) {
        return;
      }
    }
    throw Error("context osmesa: libOSMesa has no OpenGL 3.3 of this profile");
  }
  ~OsmesaContext() override { osmesa().destroyContext(context_); }

  void bind() override {
    if (!osmesa().makeCurrent(context_, buffer_, kUnsignedByte, kBufferSide, kBufferSide)) {
      throw Error("context osmesa: cannot be made current");
    }
  }
  void unbind() override { osmesa().makeCurrent(nullptr, nullptr, kUnsignedByte, 0, 0); }
  Context::Loader loader() const override { return load; }

private:
  static constexpr int kBufferSide = 4; ///< pixels of the default framebuffer, which nothing draws to
  OsmesaHandle context_ = nullptr;
  unsigned char buffer_[4 * kBufferSide * kBufferSide] = {};
};

} // namespace

bool isOsmesaInstalled() {
  try {
    osmesa();
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::unique_ptr<NativeContext> createOsmesaContext(const ContextOptions& options) {
  return std::make_unique<OsmesaContext>(options.profile);
}

} // namespace host
