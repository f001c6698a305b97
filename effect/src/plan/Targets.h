// Textures of the effect's own by resource, size and format: made when a plan first needs them, shared by lights that
// need the same, and given up when the last kKeptFrames frames did not.
#pragma once

#include "gl/Objects.h"
#include "plan/Framebuffers.h"
#include "plan/Resources.h"

#include <cstdint>
#include <vector>

namespace tyndall {

class Targets {
public:
  Targets(const gl::Functions& gl, Framebuffers& framebuffers) : gl_(gl), framebuffers_(framebuffers) {}
  Targets(const Targets&) = delete;
  Targets& operator=(const Targets&) = delete;
  ~Targets();

  /// The texture at the resource's size; of Lifetime::Compared there are two sides. 0 if GL is out of memory.
  gl::Uint get(Resource resource, const Extent& extent, int side = 0);

  /// A stencil buffer of the image's size; 0 if GL is out of memory.
  gl::Uint stencil(const Extent& extent);

  /// After a frame, whether it was drawn or not: gives up what was not needed for long.
  void endFrame();

  /// What it has for that extent is needed in this frame, whatever is asked for.
  void hold(const Extent& extent);

  /// GL memory held, in bytes.
  std::uint64_t bytes() const;

private:
  struct Slot {
    gl::Texture texture;
    gl::Renderbuffer stencil; // in place of a texture
    Resource resource = Resource::Count;
    Size size;
    gl::Enum format = 0;
    int bytesPerTexel = 1;
    int side = 0;
    int age = 0; // frames since it was needed
    gl::Uint name() const { return stencil ? stencil.name() : texture.name(); }
  };
  gl::Uint find(const Slot& wanted);
  gl::Uint makeRoomFor(Slot wanted);
  bool make(Slot& slot) const;
  void dropOlderThan(int age);

  const gl::Functions& gl_;
  Framebuffers& framebuffers_;
  std::vector<Slot> slots_;
};

} // namespace tyndall
