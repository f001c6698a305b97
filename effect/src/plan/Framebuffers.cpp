#include "plan/Framebuffers.h"

#include <algorithm>

namespace tyndall {

template <typename Condition>
void Framebuffers::drop(Condition&& condition) {
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), condition), entries_.end());
}

gl::Uint Framebuffers::get(const Attachments& attachments) {
  auto entry = std::find_if(entries_.begin(), entries_.end(),
                            [&](const Entry& known) { return known.attachments == attachments; });
  const bool isKnown = entry != entries_.end();
  if (!isKnown) {
    entries_.push_back({attachments, gl::Framebuffer(gl_)});
    entry = entries_.end() - 1;
  }
  const bool isAttached = isKnown && (!attachments.engines || entry->frame == frame_);
  entry->frame = frame_;
  if (isAttached || attach(*entry)) return entry->framebuffer.name();
  entries_.erase(entry);
  return 0;
}

// GL keeps what is attached, though the engine deletes it.
void Framebuffers::beginFrame() {
  ++frame_;
  drop([this](const Entry& entry) { return entry.attachments.engines && entry.frame + kKeptFrames < frame_; });
}

bool Framebuffers::attach(const Entry& entry) const {
  const Attachments& what = entry.attachments;
  gl_.BindFramebuffer(gl::DRAW_FRAMEBUFFER, entry.framebuffer.name());
  std::array<gl::Enum, 3> buffers{};
  gl::Sizei count = 1;
  for (gl::Enum i = 0; i < buffers.size(); ++i) {
    const gl::Uint texture = what.colours[i];
    const gl::Enum point = gl::COLOR_ATTACHMENT0 + i;
    if (what.layers[i] < 0 || !texture)
      gl_.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, point, gl::TEXTURE_2D, texture, 0);
    else
      gl_.FramebufferTextureLayer(gl::DRAW_FRAMEBUFFER, point, texture, 0, what.layers[i]);
    buffers[i] = texture ? point : gl::NONE;
    if (texture) count = static_cast<gl::Sizei>(i) + 1;
  }
  gl_.FramebufferRenderbuffer(gl::DRAW_FRAMEBUFFER, gl::STENCIL_ATTACHMENT, gl::RENDERBUFFER, what.stencil);
  gl_.DrawBuffers(count, buffers.data());
  return gl_.CheckFramebufferStatus(gl::DRAW_FRAMEBUFFER) == gl::FRAMEBUFFER_COMPLETE;
}

void Framebuffers::forgetTexture(gl::Uint name) {
  drop([name](const Entry& entry) {
    const auto& colours = entry.attachments.colours;
    return std::find(colours.begin(), colours.end(), name) != colours.end();
  });
}

void Framebuffers::forgetStencil(gl::Uint name) {
  drop([name](const Entry& entry) { return entry.attachments.stencil == name; });
}

} // namespace tyndall
