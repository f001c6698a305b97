#include "plan/Targets.h"

#include "gl/Label.h"
#include "gl/OwnErrors.h"

#include <algorithm>
#include <utility>

namespace tyndall {

namespace {

bool sameSize(const Size& a, const Size& b) {
  return a.width == b.width && a.height == b.height && a.layers == b.layers;
}

// OpenGL ES takes no other channels and types for a format, though nothing is uploaded.
gl::Enum channelsOf(gl::Enum format) {
  switch (format) {
  case gl::R8:
  case gl::R32F:
    return gl::RED;
  case gl::RG16:
  case gl::RG32F:
    return gl::RG;
  case gl::RGB16F:
  case gl::RGB32F:
  case gl::R11F_G11F_B10F:
    return gl::RGB;
  default:
    return gl::RGBA;
  }
}

gl::Enum typeOf(gl::Enum format) {
  if (format == gl::R8 || format == gl::RGBA8) return gl::UNSIGNED_BYTE;
  return format == gl::RG16 || format == gl::RGBA16 ? gl::UNSIGNED_SHORT : gl::FLOAT;
}

// Floats hold what 16-bit integers do.
TexelFormat heldBy(const gl::Functions& gl, const TexelFormat& format) {
  if (gl.normalised16) return format;
  if (format.internal == gl::RG16) return {gl::RG32F, 8};
  if (format.internal == gl::RGBA16) return {gl::RGBA32F, 16};
  return format;
}

} // namespace

Targets::~Targets() { dropOlderThan(-1); }

gl::Uint Targets::get(Resource resource, const Extent& extent, int side) {
  const TexelFormat format = heldBy(gl_, formatOf(resource, extent));
  Slot slot;
  slot.resource = resource;
  slot.size = rowOf(resource).size(extent);
  slot.format = format.internal;
  slot.bytesPerTexel = format.bytes;
  slot.side = side;
  const gl::Uint known = find(slot);
  return known ? known : makeRoomFor(std::move(slot));
}

gl::Uint Targets::stencil(const Extent& extent) {
  Slot slot;
  slot.size = {extent.width, extent.height};
  slot.format = gl::STENCIL_INDEX8;
  const gl::Uint known = find(slot);
  return known ? known : makeRoomFor(std::move(slot));
}

gl::Uint Targets::find(const Slot& wanted) {
  for (Slot& slot : slots_)
    if (slot.resource == wanted.resource && slot.side == wanted.side && slot.format == wanted.format &&
        sameSize(slot.size, wanted.size)) {
      slot.age = 0;
      return slot.name();
    }
  return 0;
}

gl::Uint Targets::makeRoomFor(Slot wanted) {
  if (!make(wanted)) { // without what this frame has not needed it may fit
    dropOlderThan(0);
    if (!make(wanted)) return 0;
  }
  slots_.push_back(std::move(wanted));
  return slots_.back().name();
}

bool Targets::make(Slot& slot) const {
  gl::OwnErrors errors(gl_);
  if (slot.format == gl::STENCIL_INDEX8) {
    slot.stencil = gl::Renderbuffer(gl_);
    gl_.BindRenderbuffer(gl::RENDERBUFFER, slot.stencil.name());
    gl_.RenderbufferStorage(gl::RENDERBUFFER, slot.format, slot.size.width, slot.size.height);
    return errors.take() != gl::OUT_OF_MEMORY;
  }
  slot.texture = gl::Texture(gl_);
  gl_.ActiveTexture(gl::TEXTURE0);
  const gl::Enum target = slot.size.layers > 0 ? gl::TEXTURE_2D_ARRAY : gl::TEXTURE_2D;
  const auto format = static_cast<gl::Int>(slot.format);
  gl_.BindTexture(target, slot.texture.name());
  gl_.TexParameteri(target, gl::TEXTURE_MAX_LEVEL, 0);
  if (slot.size.layers > 0)
    gl_.TexImage3D(target, 0, format, slot.size.width, slot.size.height, slot.size.layers, 0, channelsOf(slot.format),
                   typeOf(slot.format), nullptr);
  else
    gl_.TexImage2D(target, 0, format, slot.size.width, slot.size.height, 0, channelsOf(slot.format),
                   typeOf(slot.format), nullptr);
  gl::label(gl_, gl::TEXTURE, slot.texture.name(), rowOf(slot.resource).name);
  return errors.take() != gl::OUT_OF_MEMORY;
}

void Targets::dropOlderThan(int age) {
  for (const Slot& slot : slots_)
    if (slot.age > age && slot.stencil)
      framebuffers_.forgetStencil(slot.name());
    else if (slot.age > age)
      framebuffers_.forgetTexture(slot.name());
  slots_.erase(std::remove_if(slots_.begin(), slots_.end(), [age](const Slot& slot) { return slot.age > age; }),
               slots_.end());
}

void Targets::endFrame() {
  dropOlderThan(kKeptFrames - 1);
  for (Slot& slot : slots_)
    ++slot.age;
}

void Targets::hold(const Extent& extent) {
  for (Slot& slot : slots_) {
    if (slot.stencil) continue;
    const Size size = rowOf(slot.resource).size(extent);
    if (sameSize(size, slot.size)) slot.age = 0;
  }
}

std::uint64_t Targets::bytes() const {
  std::uint64_t sum = 0;
  for (const Slot& slot : slots_)
    sum += static_cast<std::uint64_t>(slot.size.width) * static_cast<std::uint64_t>(slot.size.height) *
           static_cast<std::uint64_t>(std::max(slot.size.layers, 1)) * static_cast<std::uint64_t>(slot.bytesPerTexel);
  return sum;
}

} // namespace tyndall
