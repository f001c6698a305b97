// Contexts that share objects, as engines have them for loading in another thread: textures of one in the frames of the
// other, and an effect in each.
#include "gl/Context.h"
#include "gl/ReadBack.h"
#include "gl/effect/SceneRig.h"
#include "support/Catch.h"

#include <array>
#include <dlfcn.h>

using namespace tyndall;

namespace {

using Handle = struct HandleTag*;

// OSMesa's functions, as its header has them.
struct Osmesa {
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  Handle (*create)(const int* attributes, Handle shared) = nullptr;
  void (*destroy)(Handle) = nullptr;
  unsigned char (*makeCurrent)(Handle, void* buffer, unsigned type, int width, int height) = nullptr;
  void (*(*load)(const char* name))() = nullptr;

  Osmesa() {
    if (!library) return;
    find("OSMesaCreateContextAttribs", create);
    find("OSMesaDestroyContext", destroy);
    find("OSMesaMakeCurrent", makeCurrent);
    find("OSMesaGetProcAddress", load);
  }
  template <typename Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(dlsym(library, name));
  }
};

const Osmesa& osmesa() {
  static const Osmesa theOsmesa;
  return theOsmesa;
}

// A core profile that shares its objects with another's.
class Shared {
public:
  explicit Shared(const Shared* other) {
    constexpr int kCore[] = {0x22, 0x1908, 0x33, 0x34, 0x36, 3, 0x37, 3, 0};
    handle_ = osmesa().create(kCore, other ? other->handle_ : nullptr);
    REQUIRE(handle_);
    context_ = host::Context::adopt([](const char* name) { return reinterpret_cast<void*>(osmesa().load(name)); },
                                    [this](bool current) { setCurrent(current); });
  }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() {
    context_.reset();
    osmesa().destroy(handle_);
  }
  host::Context& context() { return *context_; }

private:
  void setCurrent(bool current) {
    constexpr unsigned kUnsignedByte = 0x1401;
    if (current)
      osmesa().makeCurrent(handle_, buffer_.data(), kUnsignedByte, 4, 4);
    else
      osmesa().makeCurrent(nullptr, nullptr, kUnsignedByte, 0, 0);
  }
  Handle handle_ = nullptr;
  std::array<unsigned char, 64> buffer_{};
  std::unique_ptr<host::Context> context_;
};

} // namespace

TEST_CASE("contexts that share objects: textures of one in frames of the other, and effects in both in turn") {
  if (!osmesa().load) {
    WARN("skipped: libOSMesa is not installed");
    return;
  }
  Shared first(nullptr), second(&first);
  first.context().makeCurrent();
  {
    tests::SceneRig scene(24, 16, tests::RigContext::Current);
    scene.addLight(LightKind::Directional);
    scene.frame.settings.technique = Technique::Epipolar;
    std::unique_ptr<Effect> here = tests::newEffect({first.context().loader()});
    const reference::ImageAnswer expected = scene.render(*here);
    second.context().makeCurrent();
    std::unique_ptr<Effect> there = tests::newEffect({second.context().loader()});
    for (int frame = 0; frame < 4; ++frame) { // with reuse from the second on
      scene.frame.reuse.changes = frame > 0 ? Changes::Detect : Changes::Unknown;
      second.context().makeCurrent();
      const reference::ImageAnswer drawnThere = scene.render(*there);
      host::gl().Finish();
      first.context().makeCurrent();
      const reference::ImageAnswer drawnHere = scene.render(*here);
      host::gl().Finish();
      CAPTURE(frame);
      CHECK(tests::difference(drawnThere.inscatter, expected.inscatter) <= 1e-5);
      CHECK(tests::difference(drawnHere.inscatter, expected.inscatter) <= 1e-5);
    }
    // What is shared has its name in both: an effect knows its own context by what is not.
    second.context().makeCurrent();
    CHECK(here->render(scene.frame).code == StatusCode::NoContext);
    there.reset();
    first.context().makeCurrent();
    CHECK(tests::difference(scene.render(*here).inscatter, expected.inscatter) <= 1e-5);
  }
  for (Shared* each : {&first, &second})
    CHECK(each->context().takeErrors().empty());
  tests::testContext();
}
