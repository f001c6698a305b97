#include "baselines/DrawnBaseline.h"

#include <algorithm>
#include <cmath>
#include <gl/ReadBack.h>
#include <glm/gtc/type_ptr.hpp>

namespace bench {

namespace {

constexpr int kLayersPerDraw = 7;

glm::dmat4 toGlm(const tyndall::Mat4& m) { return glm::make_mat4(m.data()); }

std::vector<float> readDepth(const tyndall::Frame& frame) {
  GLint depthBits = 0;
  host::gl().ActiveTexture(GL_TEXTURE0 + kOwn);
  host::gl().BindTexture(GL_TEXTURE_2D, frame.depth.texture);
  host::gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE, &depthBits);
  return depthBits > 0 ? host::readDepth(frame.depth.texture, frame.viewport.width, frame.viewport.height)
                       : host::readColour(frame.depth.texture, frame.viewport.width, frame.viewport.height, 1);
}

/// The farthest surface: engines have the volume's far distance set by hand to suit the scene.
float farthestEnd(const tyndall::Frame& frame) {
  const std::vector<float> depths = readDepth(frame);
  const glm::dmat4 viewFromClip = glm::inverse(toGlm(frame.camera.clipFromView));
  const bool zeroToOne = frame.camera.clipDepth == tyndall::ClipDepth::ZeroToOne;
  double farthest = 0;
  for (int y = 0; y < frame.viewport.height; ++y)
    for (int x = 0; x < frame.viewport.width; ++x) {
      const double depth = depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.viewport.width) + x];
      const glm::dvec4 clip((2 * x + 1.0) / frame.viewport.width - 1, (2 * y + 1.0) / frame.viewport.height - 1,
                            zeroToOne ? depth : 2 * depth - 1, 1);
      const glm::dvec4 view = viewFromClip * clip;
      const double end = glm::length(glm::dvec3(view) / view.w);
      if (depth <= 0 || depth >= 1) continue; // the sky: as far as the medium reaches
      if (std::isfinite(end)) farthest = std::max(farthest, end);
    }
  const bool hasSky = std::any_of(depths.begin(), depths.end(), [](float d) { return d <= 0 || d >= 1; });
  if (hasSky && std::isfinite(frame.medium.farDistance)) farthest = std::max(farthest, frame.medium.farDistance);
  return static_cast<float>(std::max(farthest, 1e-20));
}

class Froxels : public DrawnBaseline {
public:
  Froxels(int width, int height, int depth) : width_(width), height_(height), depth_(depth) {}

private:
  void draw(const tyndall::Frame& frame) override {
    if (!(farEnd_ > 0)) farEnd_ = farthestEnd(frame); // once, in the warm-up
    const int draws = depth_ / kLayersPerDraw + 1;    // at least one layer more than slices, for what lies behind them
    const GLuint volume = drawer().target("volume", GL_RGBA16F, width_, height_, draws * kLayersPerDraw);
    carries_ = {drawer().target("even", GL_RGBA32F, width_, height_),
                drawer().target("odd", GL_RGBA32F, width_, height_)};
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      drawer().pass("fill" + lightSuffix(i), [&] {
        drawer().selectLight(frame, frame.lights[i]);
        for (int d = 0; d < draws; ++d)
          fill(frame, i, volume, d);
      });
    drawer().pass("apply", [&] {
      drawer().attachFinal(frame, true);
      drawer().bind(kOwn, volume, GL_TEXTURE_3D);
      setVolume(drawer().use("froxelApply.frag", drawer().definesFor(frame, nullptr), {"volume"}));
      drawer().drawFullScreen();
    });
  }

  void fill(const tyndall::Frame& frame, std::size_t light, GLuint volume, int draw) {
    drawer().attachLayers(volume, draw * kLayersPerDraw, kLayersPerDraw, carries_[static_cast<std::size_t>(draw % 2)],
                          width_, height_);
    for (GLuint i = 0; i < kLayersPerDraw && light > 0; ++i)
      host::gl().Enablei(GL_BLEND, i);
    host::gl().BlendFunc(GL_ONE, GL_ONE);
    drawer().bind(kOwn, carries_[static_cast<std::size_t>((draw + 1) % 2)]);
    host::Program& program =
        drawer().use("froxelFill.frag", drawer().definesFor(frame, &frame.lights[light]), {"carry"});
    setVolume(program);
    program.set("firstSlice", draw * kLayersPerDraw);
    drawer().drawFullScreen();
  }

  void setVolume(host::Program& program) const {
    program.set("farEnd", farEnd_);
    program.set("slices", depth_);
  }

  int width_, height_, depth_;
  float farEnd_ = 0;
  std::array<GLuint, 2> carries_{};
};

} // namespace

std::unique_ptr<Baseline> makeFroxels(int width, int height, int depth) {
  return std::make_unique<Froxels>(width, height, depth);
}

} // namespace bench
