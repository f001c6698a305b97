// A program outside the project that uses the README's integration example, word for word, in an OSMesa context.
#include <tyndall/tyndall.h>

#include <GL/osmesa.h>

#include <cmath>
#include <cstdio>
#include <dlfcn.h>
#include <vector>

namespace {

using GetProcAddress = OSMESAproc (*)(const char*);
GetProcAddress getProcAddress = nullptr;
void* loader(const char* name) { return reinterpret_cast<void*>(getProcAddress(name)); }

template <typename Function>
Function load(void* library, const char* name) {
  return reinterpret_cast<Function>(dlsym(library, name));
}

// An engine's texture, with the functions of GL 1.1 that the engine has anyway.
unsigned texture(int internal, int format, int width, int height, const std::vector<float>& values) {
  const auto gen = reinterpret_cast<void (*)(int, unsigned*)>(loader("glGenTextures"));
  const auto bind = reinterpret_cast<void (*)(unsigned, unsigned)>(loader("glBindTexture"));
  const auto image = reinterpret_cast<void (*)(unsigned, int, int, int, int, int, unsigned, unsigned, const void*)>(
      loader("glTexImage2D"));
  unsigned name = 0;
  gen(1, &name);
  bind(GL_TEXTURE_2D, name);
  image(GL_TEXTURE_2D, 0, internal, width, height, 0, static_cast<unsigned>(format), GL_FLOAT, values.data());
  return name;
}

bool fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return false;
}

void log(const std::string& message) { fail(message); }

constexpr int width = 32, height = 16;
unsigned hdrColour = 0, sceneDepth = 0, shadowMap = 0;
const float n = 0.1F, f = 100;
const float view[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
const float projection[16] = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, -(f + n) / (f - n), -1, 0, 0, -2 * f* n / (f - n), 0};
const float shadowClipFromWorld[16] = {0.05F, 0, 0, 0, 0, 0, 0.05F, 0, 0, 0.05F, 0, 0, 0, 0, 0, 1};

bool renderFrame() {
#include "example.inc"
  return true;
}

} // namespace

int main() {
  void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!library) return fail("libOSMesa.so.8 is not installed") ? 0 : 1;
  getProcAddress = load<GetProcAddress>(library, "OSMesaGetProcAddress");
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  OSMesaContext context =
      load<OSMesaContext (*)(const int*, OSMesaContext)>(library, "OSMesaCreateContextAttribs")(attributes, nullptr);
  std::vector<unsigned char> buffer(4UL * width * height);
  load<GLboolean (*)(OSMesaContext, void*, GLenum, GLsizei, GLsizei)>(library, "OSMesaMakeCurrent")(
      context, buffer.data(), GL_UNSIGNED_BYTE, width, height);

  hdrColour = texture(0x881A, GL_RGBA, width, height, std::vector<float>(4UL * width * height, 0.25F)); // GL_RGBA16F
  sceneDepth = texture(0x8CAC, GL_DEPTH_COMPONENT, width, height,
                       std::vector<float>(1UL * width * height, 0.99F)); // GL_DEPTH_COMPONENT32F
  shadowMap = texture(0x8CAC, GL_DEPTH_COMPONENT, 4, 4, std::vector<float>(16, 1));
  if (!renderFrame()) return 1;

  const auto bind = reinterpret_cast<void (*)(unsigned, unsigned)>(loader("glBindTexture"));
  const auto read = reinterpret_cast<void (*)(unsigned, int, unsigned, unsigned, void*)>(loader("glGetTexImage"));
  std::vector<float> pixels(4UL * width * height);
  bind(GL_TEXTURE_2D, hdrColour);
  read(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, pixels.data());
  for (std::size_t i = 0; i < pixels.size(); i += 4)
    if (!std::isfinite(pixels[i]) || pixels[i] == 0.25F || pixels[i + 3] != 0.25F)
      return fail("the picture did not change") ? 0 : 1;
  std::printf("the picture changed: %g to %g\n", 0.25, static_cast<double>(pixels[0]));
  return 0;
}
