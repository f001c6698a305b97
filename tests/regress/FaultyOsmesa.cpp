// Stands before the real OSMesa and changes shaders: whatever text $TYNDALL_TEST_FROM is becomes $TYNDALL_TEST_TO. So a
// test has a fault in a pass without a hook in the product. It says on standard error when it has changed one.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <string>

namespace {

using Function = void (*)();
using ShaderSource = void (*)(unsigned, int, const char* const*, const int*);

void* real(const char* name) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  static void* const library = dlopen(std::getenv("TYNDALL_TEST_OSMESA"), RTLD_LAZY | RTLD_LOCAL);
  if (!library) std::abort();
  return dlsym(library, name);
}

template <typename Signature>
Signature realAs(const char* name) {
  return reinterpret_cast<Signature>(real(name));
}

Function realGl(const char* name) { return realAs<Function (*)(const char*)>("OSMesaGetProcAddress")(name); }

void changedShaderSource(unsigned shader, int count, const char* const* texts, const int* lengths) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text.append(texts[i], lengths && lengths[i] >= 0 ? static_cast<std::size_t>(lengths[i]) : std::strlen(texts[i]));
  const char *from = std::getenv("TYNDALL_TEST_FROM"), *to = std::getenv("TYNDALL_TEST_TO"); // NOLINT
  const std::size_t at = text.find(from);
  if (at != std::string::npos) {
    text.replace(at, std::strlen(from), to);
    std::fputs("a shader has been changed\n", stderr);
  }
  const char* const pointer = text.c_str();
  reinterpret_cast<ShaderSource>(realGl("glShaderSource"))(shader, 1, &pointer, nullptr);
}

} // namespace

// NOLINTBEGIN(readability-identifier-naming): the library's names
extern "C" {

void* OSMesaCreateContextAttribs(const int* attributes, void* shared) {
  return realAs<void* (*)(const int*, void*)>("OSMesaCreateContextAttribs")(attributes, shared);
}
void OSMesaDestroyContext(void* context) { realAs<void (*)(void*)>("OSMesaDestroyContext")(context); }
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
  return realAs<unsigned char (*)(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(context, buffer, type, width,
                                                                                          height);
}
Function OSMesaGetProcAddress(const char* name) {
  return std::strcmp(name, "glShaderSource") == 0 ? reinterpret_cast<Function>(changedShaderSource) : realGl(name);
}

} // extern "C"
// NOLINTEND(readability-identifier-naming)
