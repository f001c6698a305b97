#include "baselines/DrawnBaseline.h"
#include "baselines/EpipolarLines.h"

#include <optional>

namespace bench {

namespace {

constexpr int kSpacing = 16; // samples between those that are marched anyway

class EpipolarMarch : public DrawnBaseline {
public:
  EpipolarMarch(int lines, int samples) : lines_(lines), samples_(samples) {}

  std::string reasonAgainst(const tyndall::Frame& frame) const override {
    const std::string reason = DrawnBaseline::reasonAgainst(frame);
    return reason.empty() ? reasonAgainstManyViews(frame) : reason;
  }

private:
  void draw(const tyndall::Frame& frame) override {
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      drawer().selectLight(frame, frame.lights[i]);
      light_ = &frame.lights[i];
      drawLight(frame, i);
    }
  }

  void drawLight(const tyndall::Frame& frame, std::size_t i) {
    const std::string suffix = lightSuffix(i);
    geometry_.emplace(frame, *light_, lines_, samples_);
    const GLuint table = drawer().target("lines", GL_RGBA32F, lines_, 1);
    const GLuint ends = drawer().target("ends", GL_R32F, lines_, samples_);
    const GLuint sources = drawer().target("sources", GL_RG32F, lines_, samples_);
    const GLuint marched = drawer().target("marched", GL_RGBA16F, lines_, samples_);
    const GLuint inscatter = drawer().target("inscatter", GL_RGBA16F, lines_, samples_);
    drawer().pass("lines" + suffix, [&] {
      drawer().bind(kOwn, table);
      host::gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, lines_, 1, GL_RGBA, GL_FLOAT, geometry_->ends.data());
    });
    run(frame, "ends", suffix, ends, {{"lines", table}});
    run(frame, "sources", suffix, sources, {{"lines", table}, {"sampleEnds", ends}});
    run(frame, "march", suffix, marched, {{"lines", table}, {"sampleEnds", ends}, {"sources", sources}});
    run(frame, "interpolate", suffix, inscatter, {{"sources", sources}, {"marched", marched}});
    drawer().pass("unwarp" + suffix, [&] {
      drawer().attachFinal(frame, i == 0);
      drawWith(frame, "epipolarUnwarp.frag", {{"lines", table}, {"sampleEnds", ends}, {"sampleInscatter", inscatter}});
    });
  }

  using Inputs = std::vector<std::pair<const char*, GLuint>>;

  void run(const tyndall::Frame& frame, const std::string& name, const std::string& suffix, GLuint target,
           const Inputs& inputs) {
    drawer().pass(name + suffix, [&] {
      drawer().attach({target}, lines_, samples_);
      std::string file = "epipolar" + name + ".frag";
      file[8] = static_cast<char>(std::toupper(static_cast<unsigned char>(file[8])));
      drawWith(frame, file, inputs);
    });
  }

  void drawWith(const tyndall::Frame& frame, const std::string& file, const Inputs& inputs) {
    std::vector<const char*> samplers;
    for (const auto& [sampler, texture] : inputs) {
      drawer().bind(kOwn + static_cast<int>(samplers.size()), texture);
      samplers.push_back(sampler);
    }
    host::Program& program = drawer().use(file, drawer().definesFor(frame, light_), samplers);
    geometry_->set(program);
    program.set("spacing", kSpacing);
    drawer().drawFullScreen();
  }

  int lines_, samples_;
  const tyndall::Light* light_ = nullptr;
  std::optional<EpipolarLines> geometry_;
};

} // namespace

std::unique_ptr<Baseline> makeEpipolarMarch(int slices, int samples) {
  return std::make_unique<EpipolarMarch>(slices, samples);
}

} // namespace bench
