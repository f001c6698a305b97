#include "Targets.h"

namespace tyndall {

namespace {

struct Row {
  const char* name;
  gl::Enum format;
  int bytesPerTexel;
  const char* reason;
};

constexpr Row kRows[] = {
    {"inscatter", gl::RGBA32F, 16, "sum over the lights where the engine wants its own transmittance and a composite"},
    {"transmittance", gl::RGBA32F, 16, "where the engine wants its own inscatter and a composite"},
};

} // namespace

gl::Uint Targets::get(Target target, int width, int height) {
  const auto index = static_cast<std::size_t>(target);
  Slot& slot = slots_[index];
  if (slot.texture && slot.width == width && slot.height == height) return slot.texture.name();
  slot = Slot{gl::Texture(gl_), width, height};
  gl_.ActiveTexture(gl::TEXTURE0);
  gl_.BindTexture(gl::TEXTURE_2D, slot.texture.name());
  gl_.TexParameteri(gl::TEXTURE_2D, gl::TEXTURE_MAX_LEVEL, 0);
  gl_.TexImage2D(gl::TEXTURE_2D, 0, static_cast<gl::Int>(kRows[index].format), width, height, 0, gl::RGBA, gl::FLOAT,
                 nullptr);
  if (gl_.GetError() == gl::OUT_OF_MEMORY) slot = Slot{};
  return slot.texture.name();
}

std::uint64_t Targets::bytes() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].texture)
      sum += static_cast<std::uint64_t>(slots_[i].width) * static_cast<std::uint64_t>(slots_[i].height) *
             static_cast<std::uint64_t>(kRows[i].bytesPerTexel);
  return sum;
}

} // namespace tyndall
