// A program outside the project that uses the README's integration example, word for word.
#ifdef _WIN32
#include <windows.h> // as engines have it: its macros must not hurt
#endif

#include <tyndall/tyndall.h>

#include "Context.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

void* (*loader)(const char* name) = nullptr;

constexpr unsigned kTexture2D = 0x0DE1, kFloat = 0x1406, kDepthComponent = 0x1902, kRgba = 0x1908, kRgba16F = 0x881A,
                   kDepthComponent32F = 0x8CAC;

// An engine's texture, with the functions of GL 1.1 that the engine has anyway.
unsigned texture(unsigned internal, unsigned format, int width, int height, const std::vector<float>& values) {
  const auto gen = reinterpret_cast<void (*)(int, unsigned*)>(loader("glGenTextures"));
  const auto bind = reinterpret_cast<void (*)(unsigned, unsigned)>(loader("glBindTexture"));
  const auto image = reinterpret_cast<void (*)(unsigned, int, int, int, int, int, unsigned, unsigned, const void*)>(
      loader("glTexImage2D"));
  unsigned name = 0;
  gen(1, &name);
  bind(kTexture2D, name);
  image(kTexture2D, 0, static_cast<int>(internal), width, height, 0, format, kFloat, values.data());
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
// Orthographic, 40 across, looking along the example's sun.
const float shadowClipFromWorld[16] = {-0.0468164F, -0.0088672F, 0.0151523F, 0,          -0.0175562F, 0.0236458F,
                                       -0.0404061F, 0,           0,          0.0431537F, 0.0252538F,  0,
                                       0,           0,           0,          1};

bool renderFrame() {
#include "example.inc"
  return true;
}

} // namespace

int main() {
  loader = openContext();
  if (!loader) return fail("skipped: no OpenGL context here") ? 0 : 1; // tests/package looks for this line
  hdrColour = texture(kRgba16F, kRgba, width, height, std::vector<float>(4UL * width * height, 0.25F));
  sceneDepth =
      texture(kDepthComponent32F, kDepthComponent, width, height, std::vector<float>(1UL * width * height, 0.99F));
  shadowMap = texture(kDepthComponent32F, kDepthComponent, 4, 4, std::vector<float>(16, 1));
  if (!renderFrame()) return 1;

  const auto bind = reinterpret_cast<void (*)(unsigned, unsigned)>(loader("glBindTexture"));
  const auto read = reinterpret_cast<void (*)(unsigned, int, unsigned, unsigned, void*)>(loader("glGetTexImage"));
  std::vector<float> pixels(4UL * width * height);
  bind(kTexture2D, hdrColour);
  read(kTexture2D, 0, kRgba, kFloat, pixels.data());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const bool same = pixels[i] == 0.25F && pixels[i + 1] == 0.25F && pixels[i + 2] == 0.25F;
    if (!std::isfinite(pixels[i]) || same || pixels[i + 3] != 0.25F) return fail("the picture did not change") ? 0 : 1;
  }
  std::printf("the picture changed: %g to %g\n", 0.25, static_cast<double>(pixels[0]));
  return 0;
}
