// Every rule about a frame's textures: a valid frame with one texture broken is refused with field, name and rule.
#include "RefusalRig.h"
#include "gl/avsm/AvsmRig.h"
#include "support/Catch.h"

#include <functional>

using namespace tyndall;
using host::gl;

namespace {

constexpr int kSize = tests::RefusalRig::kSize, kShadowSize = tests::RefusalRig::kShadowSize;

enum class Use { Target, Depth, Map, Tint, Share };

// A texture field of a frame and what it holds.
struct Slot {
  std::string field;
  std::function<std::uint32_t&(Frame&)> name;
  Use use;
  int layers;            // 0: GL_TEXTURE_2D
  bool setsSize = false; // other textures follow its size, or none has to
  int size() const { return field.rfind("lights", 0) == 0 ? kShadowSize : kSize; }
};

const std::vector<Slot> kSlots = {
    {"colour", [](Frame& f) -> std::uint32_t& { return f.colour; }, Use::Target, 0, true},
    {"output.inscatter", [](Frame& f) -> std::uint32_t& { return f.output.inscatter; }, Use::Target, 0},
    {"output.transmittance", [](Frame& f) -> std::uint32_t& { return f.output.transmittance; }, Use::Target, 0},
    {"depth.texture", [](Frame& f) -> std::uint32_t& { return f.depth.texture; }, Use::Depth, 0},
    {"lights[0].shadow.texture", [](Frame& f) -> std::uint32_t& { return f.lights[0].shadow.texture; }, Use::Map, 2,
     true},
    {"lights[0].glass.colour", [](Frame& f) -> std::uint32_t& { return f.lights[0].glass.colour; }, Use::Tint, 2},
    {"lights[0].glass.depth", [](Frame& f) -> std::uint32_t& { return f.lights[0].glass.depth; }, Use::Map, 2},
    {"lights[1].shadow.texture", [](Frame& f) -> std::uint32_t& { return f.lights[1].shadow.texture; }, Use::Map, 6,
     true},
    {"lights[2].shadow.texture", [](Frame& f) -> std::uint32_t& { return f.lights[2].shadow.texture; }, Use::Map, 0,
     true},
    {"lights[2].glass.colour", [](Frame& f) -> std::uint32_t& { return f.lights[2].glass.colour; }, Use::Tint, 0},
    {"lights[2].glass.depth", [](Frame& f) -> std::uint32_t& { return f.lights[2].glass.depth; }, Use::Map, 0},
    {"ambient.occlusion.texture", [](Frame& f) -> std::uint32_t& { return f.ambient.occlusion.texture; }, Use::Share, 0,
     true},
};

GLenum goodFormat(Use use) {
  return use == Use::Target  ? GL_RGBA16F
         : use == Use::Tint  ? GL_RGBA8
         : use == Use::Share ? GL_R8
                             : GL_DEPTH_COMPONENT24;
}

host::GlTexture make(int layers, GLenum format, int width, int height) {
  return layers == 0 ? host::makeTexture2D(format, width, height)
                     : host::makeTextureArray(format, width, height, layers);
}

// Puts a name into a slot and requires a refusal that names slot, texture and rule.
void refuse(tests::RefusalRig& rig, const Slot& slot, std::uint32_t name, const std::string& rule) {
  CAPTURE(slot.field, rule);
  Frame broken = rig.frame;
  slot.name(broken) = name;
  rig.checkRefused(broken, {"Frame::" + slot.field + " is texture " + std::to_string(name), rule});
}

const char* formatRule(Use use) {
  return use == Use::Target  ? "must have a float colour format"
         : use == Use::Depth ? "must have a depth format or R32F"
         : use == Use::Map   ? "must have a depth format, R16F, R32F or RG32F"
         : use == Use::Share ? "must have the format R8, R16, R16F or R32F"
                             : "must have an RGB or RGBA format";
}

} // namespace

TEST_CASE("a name that is no texture is refused") {
  tests::RefusalRig rig;
  for (const Slot& slot : kSlots) {
    host::GlTexture texture = host::makeTexture2D(GL_RGBA16F, 1, 1);
    const GLuint deleted = texture.name();
    texture.reset();
    refuse(rig, slot, deleted, "not the name of a texture");
    const host::GlTexture neverBound = host::makeTexture();
    refuse(rig, slot, neverBound.name(), "not the name of a texture");
    refuse(rig, slot, 123456789, "not the name of a texture");
  }
  Frame noDepth = rig.frame;
  noDepth.depth.texture = 0;
  rig.checkRefused(noDepth, {"Frame::depth.texture"});
  rig.checkAccepted(rig.frame);
}

TEST_CASE("a texture without storage is refused") {
  tests::RefusalRig rig;
  for (const Slot& slot : kSlots) {
    const host::GlTexture empty = host::makeTexture();
    gl().BindTexture(slot.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY, empty.name());
    refuse(rig, slot, empty.name(), "no level 0");
  }
}

TEST_CASE("a texture of another target is refused") {
  tests::RefusalRig rig;
  for (const Slot& slot : kSlots) {
    const std::string rule = slot.layers == 0 ? "must be a GL_TEXTURE_2D" : "must be a GL_TEXTURE_2D_ARRAY";
    const host::GlTexture swapped = make(slot.layers == 0 ? 2 : 0, goodFormat(slot.use), slot.size(), slot.size());
    refuse(rig, slot, swapped.name(), rule);
    const host::GlTexture samples = host::makeTexture2DMultisample(goodFormat(slot.use), slot.size(), slot.size(), 4);
    refuse(rig, slot, samples.name(), rule);
    const host::GlTexture cube = host::makeTexture();
    gl().BindTexture(GL_TEXTURE_CUBE_MAP, cube.name());
    refuse(rig, slot, cube.name(), rule);
  }
}

TEST_CASE("a texture whose target the frame gets wrong is refused") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  frame.depth.multisampled = true;
  rig.checkRefused(frame, {"Frame::depth.texture", "must be a GL_TEXTURE_2D_MULTISAMPLE"});
  frame = rig.frame;
  frame.lights[1].shadow.array = false;
  for (ShadowView& view : frame.lights[1].shadow.views)
    view.layer = 0;
  rig.checkRefused(frame, {"Frame::lights[1].shadow", "GL_TEXTURE_2D"});
  frame = rig.frame;
  frame.lights[2].shadow.array = true;
  rig.checkRefused(frame, {"Frame::lights[2].shadow.texture", "must be a GL_TEXTURE_2D_ARRAY"});
  frame = rig.frame; // the glass follows the shadow map's target
  frame.lights[0].glass = rig.frame.lights[2].glass;
  rig.checkRefused(frame, {"Frame::lights[0].glass.colour", "must be a GL_TEXTURE_2D_ARRAY"});
  const host::GlTexture samples = host::makeTexture2DMultisample(GL_DEPTH_COMPONENT24, kSize + 1, kSize, 4);
  frame = rig.frame;
  frame.depth = {samples.name(), true};
  rig.checkRefused(frame, {"Frame::depth.texture", "is 9 x 8, must be 8 x 8"});
}

TEST_CASE("a texture of a wrong format is refused") {
  tests::RefusalRig rig;
  const std::vector<GLenum> targets = {GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA16, GL_R32F, GL_RG32F, GL_DEPTH_COMPONENT24};
  const std::vector<GLenum> depths = {GL_RGBA32F, GL_R16F, GL_R16, GL_RG32F, GL_RGBA8};
  const std::vector<GLenum> maps = {GL_RGBA32F, GL_R16, GL_RG16F, GL_RGBA8};
  const std::vector<GLenum> shares = {GL_RGBA8, GL_RG8, GL_RGBA16F, GL_DEPTH_COMPONENT24};
  const std::vector<GLenum> tints = {GL_R8, GL_RG8, GL_R32F, GL_DEPTH_COMPONENT24};
  for (const Slot& slot : kSlots)
    for (const GLenum format : slot.use == Use::Target  ? targets
                               : slot.use == Use::Depth ? depths
                               : slot.use == Use::Map   ? maps
                               : slot.use == Use::Share ? shares
                                                        : tints) {
      CAPTURE(format);
      const host::GlTexture texture = make(slot.layers, format, slot.size(), slot.size());
      refuse(rig, slot, texture.name(), formatRule(slot.use));
    }
  for (const Slot& slot : kSlots) { // integer textures need an integer transfer format
    const host::GlTexture integers = host::makeTexture();
    const GLenum target = slot.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    gl().BindTexture(target, integers.name());
    if (slot.layers == 0)
      gl().TexImage2D(target, 0, GL_RGBA16UI, slot.size(), slot.size(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, nullptr);
    else
      gl().TexImage3D(target, 0, GL_RGBA16UI, slot.size(), slot.size(), slot.layers, 0, GL_RGBA_INTEGER,
                      GL_UNSIGNED_SHORT, nullptr);
    refuse(rig, slot, integers.name(), formatRule(slot.use));
  }
}

TEST_CASE("a texture of a wrong size is refused") {
  tests::RefusalRig rig;
  for (const Slot& slot : kSlots) {
    if (slot.setsSize) continue;
    const int right = slot.size();
    for (const auto& [width, height] : std::vector<std::pair<int, int>>{
             {right + 1, right}, {right, right + 1}, {right - 1, right}, {right, right - 1}, {2 * right, 2 * right}}) {
      const host::GlTexture texture = make(slot.layers, goodFormat(slot.use), width, height);
      refuse(rig, slot, texture.name(),
             "is " + std::to_string(width) + " x " + std::to_string(height) + ", must be " + std::to_string(right) +
                 " x " + std::to_string(right));
    }
  }
}

TEST_CASE("glass with fewer layers than its shadow map is refused") {
  tests::RefusalRig rig;
  const Slot& colour = kSlots[5];
  const Slot& depth = kSlots[6];
  const host::GlTexture tint = make(1, GL_RGB8, kShadowSize, kShadowSize);
  refuse(rig, colour, tint.name(), "fewer layers");
  const host::GlTexture pane = make(1, GL_R32F, kShadowSize, kShadowSize);
  refuse(rig, depth, pane.name(), "fewer layers");
}

TEST_CASE("a base level other than 0 is refused") {
  tests::RefusalRig rig;
  for (const Slot& slot : kSlots) {
    const host::GlTexture texture = make(slot.layers, goodFormat(slot.use), slot.size(), slot.size());
    const GLenum target = slot.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    gl().TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 1000);
    gl().TexParameteri(target, GL_TEXTURE_BASE_LEVEL, 1);
    refuse(rig, slot, texture.name(), "GL_TEXTURE_BASE_LEVEL must be 0");
  }
}

// Samplers do not undo it, and what is read of depth is one channel.
TEST_CASE("a texture whose swizzle changes what is read of it is refused, a tint in another order is not") {
  tests::RefusalRig rig;
  const std::vector<GLint> own = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
  for (const Slot& slot : kSlots) {
    const GLenum target = slot.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    const int read = slot.use == Use::Depth || slot.use == Use::Map || slot.use == Use::Share ? 1
                     : slot.field.rfind("output", 0) == 0                                     ? 3
                                                                                              : 0;
    for (int channel = 0; channel < 4; ++channel)
      for (const GLint source : {GL_ZERO, GL_ONE, GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA}) {
        if (source == own[static_cast<std::size_t>(channel)]) continue;
        CAPTURE(channel, source);
        const host::GlTexture texture = make(slot.layers, goodFormat(slot.use), slot.size(), slot.size());
        gl().TexParameteri(target, GL_TEXTURE_SWIZZLE_R + static_cast<GLenum>(channel), source);
        if (channel < read) {
          refuse(rig, slot, texture.name(), std::string("GL_TEXTURE_SWIZZLE_") + "RGB"[channel] + " must be GL_");
        } else if (source == GL_ZERO) {
          Frame good = rig.frame;
          slot.name(good) = texture.name();
          rig.checkAccepted(good);
        }
      }
  }
}

TEST_CASE("a depth texture that is set to give its stencil is refused") {
  tests::RefusalRig rig;
  if (tests::testContext().glVersion() < 43 && !tests::hasExtension("GL_ARB_stencil_texturing")) {
    WARN("skipped: this context has no GL_DEPTH_STENCIL_TEXTURE_MODE");
    return;
  }
  for (const Slot& slot : kSlots) {
    if (slot.use != Use::Depth && slot.use != Use::Map) continue;
    const host::GlTexture texture = make(slot.layers, GL_DEPTH24_STENCIL8, slot.size(), slot.size());
    const GLenum target = slot.layers == 0 ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY;
    gl().TexParameteri(target, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    refuse(rig, slot, texture.name(), "GL_DEPTH_STENCIL_TEXTURE_MODE must be GL_DEPTH_COMPONENT");
  }
}

TEST_CASE("a target that is written twice, or read while it is written, is refused") {
  tests::RefusalRig rig;
  Frame frame = rig.frame;
  frame.output.inscatter = frame.colour;
  rig.checkRefused(frame, {"Frame::output.inscatter", "must differ from colour"});
  frame = rig.frame;
  frame.output.transmittance = frame.colour;
  rig.checkRefused(frame, {"Frame::output.transmittance", "must differ from colour"});
  frame = rig.frame;
  frame.output.transmittance = frame.output.inscatter;
  rig.checkRefused(frame, {"Frame::output.inscatter", "must differ", "output.transmittance"});
  for (const std::uint32_t target : {rig.frame.colour, rig.frame.output.inscatter, rig.frame.output.transmittance}) {
    frame = rig.frame;
    frame.ambient.occlusion.texture = target;
    rig.checkRefused(frame, {"Frame::ambient.occlusion.texture", "must"});
  }
  const host::GlTexture map = host::makeTexture2D(GL_DEPTH_COMPONENT24, kSize, kSize);
  for (const std::uint32_t target : {rig.frame.colour, rig.frame.output.inscatter, rig.frame.output.transmittance}) {
    frame = rig.frame; // a float colour target would pass as a tint of the same size
    frame.lights[2].shadow.texture = map.name();
    frame.lights[2].glass = {target, map.name()};
    rig.checkRefused(frame, {"Frame::lights[2].glass.colour", "must differ"});
  }
}

TEST_CASE("every format that the header names is accepted") {
  tests::RefusalRig rig;
  rig.frame.lights.resize(1); // a driver compiles each light's shader anew for each format
  const std::vector<GLenum> targets = {GL_RGBA16F, GL_RGBA32F, GL_R11F_G11F_B10F};
  const std::vector<GLenum> depths = {GL_DEPTH_COMPONENT16,
                                      GL_DEPTH_COMPONENT24,
                                      GL_DEPTH_COMPONENT32,
                                      GL_DEPTH_COMPONENT32F,
                                      GL_DEPTH24_STENCIL8,
                                      GL_DEPTH32F_STENCIL8,
                                      GL_R32F};
  const std::vector<GLenum> tints = {GL_RGB8,    GL_RGBA8,  GL_SRGB8,   GL_SRGB8_ALPHA8,  GL_RGB16F,
                                     GL_RGBA16F, GL_RGB32F, GL_RGBA32F, GL_R11F_G11F_B10F};
  const auto acceptInAll = [&](Use use, GLenum format) {
    CAPTURE(format);
    Frame frame = rig.frame;
    std::vector<host::GlTexture> textures;
    for (const Slot& slot : kSlots) {
      if (slot.use != use || slot.field.rfind("lights[0]", 0) != 0) continue;
      textures.push_back(make(slot.layers, format, slot.size(), slot.size()));
      slot.name(frame) = textures.back().name();
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (kSlots[i].use != use) continue;
      textures.push_back(make(0, format, kSize, kSize));
      kSlots[i].name(frame) = textures.back().name();
    }
    rig.checkAccepted(frame);
  };
  for (const GLenum format : targets)
    acceptInAll(Use::Target, format);
  for (const GLenum format : depths) {
    acceptInAll(Use::Depth, format);
    acceptInAll(Use::Map, format);
  }
  for (const GLenum format : {GL_R16F, GL_RG32F})
    acceptInAll(Use::Map, format);
  for (const GLenum format : tints)
    acceptInAll(Use::Tint, format);
}

// GL leaves it to the context whether three-channel float formats can be rendered to.
TEST_CASE("a target that the context cannot render to is refused") {
  tests::RefusalRig rig;
  rig.frame.lights.clear();
  for (const Slot& slot : kSlots)
    for (const GLenum format : {GL_RGB16F, GL_RGB32F}) {
      if (slot.use != Use::Target) continue;
      CAPTURE(slot.field, format);
      const host::GlTexture texture = host::makeTexture2D(format, kSize, kSize);
      const host::GlFramebuffer framebuffer = host::makeFramebuffer();
      gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
      gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
      const bool renderable = gl().CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
      gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
      Frame frame = rig.frame;
      slot.name(frame) = texture.name();
      if (renderable)
        rig.checkAccepted(frame);
      else
        rig.checkRefused(frame, {"cannot render"});
    }
}
