#include "baselines/DrawnBaseline.h"

#include <algorithm>

namespace bench {

namespace {

class Pyramid : public DrawnBaseline {
public:
  std::string reasonAgainst(const tyndall::Frame& frame) const override {
    const std::string reason = DrawnBaseline::reasonAgainst(frame);
    if (hasGlass(frame)) return "takes no glass";
    return reason.empty() ? reasonAgainstManyViews(frame) : reason;
  }

  std::uint64_t bytes() const override {
    std::uint64_t sum = 0;
    for (const glm::ivec2& size : sizes_)
      sum += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) * 8;
    return sum;
  }

private:
  void draw(const tyndall::Frame& frame) override {
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      const tyndall::Light& light = frame.lights[i];
      drawer().selectLight(frame, light);
      const Defines defines = drawer().definesFor(frame, &light);
      drawer().pass("pyramid" + lightSuffix(i), [&] { build(defines); });
      drawer().pass("walk" + lightSuffix(i), [&] {
        drawer().attachFinal(frame, i == 0);
        drawer().bind(kOwn, texture_.name());
        drawer().use("pyramidWalk.frag", defines, {"pyramid"}).set("top", static_cast<int>(sizes_.size()));
        drawer().drawFullScreen();
      });
    }
  }

  void allocate(const glm::ivec2& mapSize) {
    std::vector<glm::ivec2> sizes;
    for (glm::ivec2 size = mapSize; std::max(size.x, size.y) > 1;)
      sizes.push_back(size = (size + 1) / 2);
    if (sizes == sizes_) return;
    sizes_ = sizes;
    const GladGLContext& gl = host::gl();
    gl.ActiveTexture(GL_TEXTURE0 + kOwn);
    texture_ = host::makeTexture();
    gl.BindTexture(GL_TEXTURE_2D, texture_.name());
    for (std::size_t level = 0; level < sizes_.size(); ++level)
      gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(level), GL_RG32F, sizes_[level].x, sizes_[level].y, 0, GL_RG,
                    GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }

  /// While a level is drawn, only the one below it can be read.
  void setReadable(std::size_t first, std::size_t last) const {
    drawer().bind(kOwn, texture_.name());
    host::gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, static_cast<GLint>(first));
    host::gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(last));
  }

  void build(const Defines& defines) {
    allocate(drawer().shadowSize());
    for (std::size_t level = 0; level < sizes_.size(); ++level) {
      setReadable(level == 0 ? 0 : level - 1, level == 0 ? 0 : level - 1);
      drawer().attach({texture_.name()}, sizes_[level].x, sizes_[level].y);
      host::gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(),
                                      static_cast<GLint>(level));
      if (level == 0)
        drawer().use("pyramidBase.frag", defines);
      else
        drawer().use("pyramidLevel.frag", {}, {"pyramid"});
      drawer().drawFullScreen();
    }
    setReadable(0, sizes_.size() - 1);
  }

  std::vector<glm::ivec2> sizes_; ///< of the levels, from half the map's on
  host::GlTexture texture_;
};

} // namespace

std::unique_ptr<Baseline> makePyramid() { return std::make_unique<Pyramid>(); }

} // namespace bench
