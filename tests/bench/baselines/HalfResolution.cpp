#include "baselines/DrawnBaseline.h"

namespace bench {

namespace {

class HalfResolution : public DrawnBaseline {
public:
  explicit HalfResolution(int steps) : steps_(steps) {}

private:
  void draw(const tyndall::Frame& frame) override {
    width_ = (frame.viewport.width + 1) / 2;
    height_ = (frame.viewport.height + 1) / 2;
    end_ = drawer().target("end", GL_R32F, width_, height_);
    const GLuint inscatter = drawer().target("inscatter", GL_RGBA16F, width_, height_);
    const GLuint other = drawer().target("blurred", GL_RGBA16F, width_, height_);
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      drawer().pass("march" + lightSuffix(i), [&] { march(frame, i, inscatter); });
    drawer().pass("blur", [&] {
      blur(frame, inscatter, other, {1, 0});
      blur(frame, other, inscatter, {0, 1});
    });
    drawer().pass("upsample", [&] {
      drawer().attachFinal(frame, true);
      bindHalf(inscatter);
      drawer().use("halfUpsample.frag", drawer().definesFor(frame, nullptr), kSamplers);
      drawer().drawFullScreen();
    });
  }

  void march(const tyndall::Frame& frame, std::size_t light, GLuint inscatter) {
    drawer().selectLight(frame, frame.lights[light]);
    if (light == 0) {
      drawer().attach({inscatter, end_}, width_, height_);
    } else {
      drawer().attach({inscatter}, width_, height_);
      host::gl().Enable(GL_BLEND);
      host::gl().BlendFunc(GL_ONE, GL_ONE);
    }
    drawer().use("halfMarch.frag", drawer().definesFor(frame, &frame.lights[light])).set("steps", steps_);
    drawer().drawFullScreen();
  }

  void blur(const tyndall::Frame& frame, GLuint from, GLuint to, const glm::vec2& axis) {
    drawer().attach({to}, width_, height_);
    bindHalf(from);
    drawer().use("halfBlur.frag", drawer().definesFor(frame, nullptr), kSamplers).set("axis", axis);
    drawer().drawFullScreen();
  }

  void bindHalf(GLuint inscatter) const {
    drawer().bind(kOwn, inscatter);
    drawer().bind(kOwn + 1, end_);
  }

  inline static const std::vector<const char*> kSamplers = {"halfInscatter", "halfEnd"};
  int steps_;
  int width_ = 0, height_ = 0;
  GLuint end_ = 0;
};

} // namespace

std::unique_ptr<Baseline> makeHalfResolution(int steps) { return std::make_unique<HalfResolution>(steps); }

} // namespace bench
