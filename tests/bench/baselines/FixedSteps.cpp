#include "baselines/DrawnBaseline.h"

namespace bench {

namespace {

class FixedSteps : public DrawnBaseline {
public:
  explicit FixedSteps(int steps) : steps_(steps) {}

private:
  void draw(const tyndall::Frame& frame) override {
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      drawer().pass("march" + lightSuffix(i), [&] {
        drawer().selectLight(frame, frame.lights[i]);
        drawer().attachFinal(frame, i == 0);
        drawer().use("fixedSteps.frag", drawer().definesFor(frame, &frame.lights[i])).set("steps", steps_);
        drawer().drawFullScreen();
      });
  }

  int steps_;
};

} // namespace

std::unique_ptr<Baseline> makeFixedSteps(int steps) { return std::make_unique<FixedSteps>(steps); }

} // namespace bench
