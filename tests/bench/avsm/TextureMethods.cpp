// Methods that keep a fixed number of sums a texel, which blending could make as well: here a shader makes them of the
// lists.
#include "Methods.h"

namespace avsmbench {

namespace {

using host::gl;

struct Sums {
  std::string build, lookUp; ///< shaders
  Defines defines;
  GLenum target = GL_TEXTURE_2D_ARRAY, format = GL_RGBA32F;
  int layers = 1;
  int values = 0; ///< of 4 bytes that a texel keeps
};

class TextureMethod : public Method {
public:
  TextureMethod(tyndall::Avsm& lists, int size, Sums sums)
      : lists_(lists), size_(size), sums_(std::move(sums)), program_({sums_.build}, sums_.defines),
        texture_(host::makeTexture()) {
    gl().ActiveTexture(GL_TEXTURE0);
    gl().BindTexture(sums_.target, texture_.name());
    gl().TexStorage3D(sums_.target, 1, sums_.format, size, size, sums_.layers);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl().TexParameteri(sums_.target, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
      gl().TexParameteri(sums_.target, wrap, GL_CLAMP_TO_EDGE);
  }

  tyndall::Avsm& lists() override { return lists_; }

  void build() override {
    program_.use();
    gl().BindImageTexture(0, texture_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, sums_.format);
    const auto groups = static_cast<std::size_t>((size_ + 7) / 8);
    ComputeProgram::dispatch(groups, groups);
  }

  std::vector<std::string> lookUpFiles() const override { return {sums_.lookUp}; }
  Defines lookUpDefines() const override { return sums_.defines; }

  void bindForLookUp() const override {
    gl().ActiveTexture(GL_TEXTURE0);
    gl().BindTexture(sums_.target, texture_.name());
  }

  bool filters() const override { return true; }
  std::uint64_t bytes() const override {
    return std::uint64_t{4} * static_cast<std::uint64_t>(size_ * size_ * sums_.values);
  }

private:
  tyndall::Avsm& lists_;
  int size_;
  Sums sums_;
  ComputeProgram program_;
  host::GlTexture texture_;
};

} // namespace

MethodPointer makeOpacity(tyndall::Avsm& lists, int size, int slices) {
  return std::make_unique<TextureMethod>(
      lists, size,
      Sums{"opacityBuild.comp", "opacityLookUp.glsl", {{"SLICES", slices}}, GL_TEXTURE_3D, GL_R32F, slices, slices});
}

MethodPointer makeFourier(tyndall::Avsm& lists, int size, int terms) {
  return std::make_unique<TextureMethod>(lists, size,
                                         Sums{"fourierBuild.comp",
                                              "fourierLookUp.glsl",
                                              {{"TERMS", terms}},
                                              GL_TEXTURE_2D_ARRAY,
                                              GL_RGBA32F,
                                              terms / 2,
                                              2 * terms});
}

MethodPointer makeMoments(tyndall::Avsm& lists, int size, int moments) {
  return std::make_unique<TextureMethod>(lists, size,
                                         Sums{"momentBuild.comp",
                                              "momentLookUp.glsl",
                                              {{"MOMENTS", moments}},
                                              GL_TEXTURE_2D_ARRAY,
                                              GL_RGBA32F,
                                              2,
                                              moments + 1});
}

} // namespace avsmbench
