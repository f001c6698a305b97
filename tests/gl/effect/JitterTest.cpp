// Cameras that temporal antialiasing jitters (Camera::jitter): the picture without it, moved; what a mean over frames
// comes to; and what of it is reused.
#include "ReuseRig.h"
#include "reference/CameraRays.h"

#include <cmath>
#include <functional>
#include <limits>

using namespace tyndall;
using namespace tests::reuse;

namespace {

using Jitter = std::array<double, 2>;

double radicalInverse(int index, int base) {
  double result = 0, share = 1;
  for (; index > 0; index /= base)
    result += (share /= base) * (index % base);
  return result;
}

// The i-th of Halton's points of bases 2 and 3 in a pixel, around its centre.
Jitter halton(int i) { return {radicalInverse(i + 1, 2) - 0.5, radicalInverse(i + 1, 3) - 0.5}; }

constexpr int kFrames = 16;

// Moves the projection of a rig's camera by so many pixels, as an engine does, and what it sees along.
class JitteredCamera {
public:
  explicit JitteredCamera(tests::ShaftRig& rig) : rig_(rig), still_(rig.scene.frame.camera.clipFromView) {}
  void set(const Jitter& jitter, bool named = true) {
    Frame& frame = rig_.scene.frame;
    const glm::dvec3 ndc(2 * jitter[0] / frame.viewport.width, 2 * jitter[1] / frame.viewport.height, 0);
    frame.camera.clipFromView = tests::toMat4(glm::translate(glm::dmat4(1), ndc) * reference::toMat4(still_));
    for (double& entry : frame.camera.clipFromView) // as most engines hold them
      entry = static_cast<double>(static_cast<float>(entry));
    frame.camera.jitter = named ? jitter : Jitter{0, 0};
    rig_.look(frame.camera.viewFromWorld); // which renders depth anew
  }

private:
  tests::ShaftRig& rig_;
  Mat4 still_;
};

} // namespace
TEST_CASE("print jitter") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
    tests::ShaftRig rig(96, 64);
    rig.addLight(kind == LightKind::Directional ? sun() : kind == LightKind::Spot ? spot() : point(), 128);
    rig.scene.frame.settings.technique = Technique::Epipolar;
    JitteredCamera camera(rig);
    rig.scene.frame.reuse.changes = Changes::Detect;
    rig.scene.frame.reuse.eye = newView();
    for (int i = 0; i < kFrames; ++i) {
      camera.set(halton(i));
      rig.scene.frame.lights[0].shadow.version = 3;
      ++rig.scene.frame.reuse.frame;
      const Picture p = reused(rig);
      const auto f = full(rig);
      rig.scene.frame.settings.technique = Technique::Exact;
      const auto truth = full(rig).inscatter;
      rig.scene.frame.settings.technique = Technique::Epipolar;
      camera.set(halton(i), false);
      const auto unnamed = full(rig);
      rig.scene.frame.settings.technique = Technique::Exact;
      const auto unnamedExact = full(rig);
      rig.scene.frame.settings.technique = Technique::Epipolar;
      { double worst=0; int wx=0,wy=0; for(int y=0;y<64;++y)for(int x=0;x<96;++x){double e=glm::length(f.inscatter.at(x,y)-truth.at(x,y)); if(e>worst){worst=e;wx=x;wy=y;}}
        std::printf("worst %d %d: %g vs %g; inner err %.4f\n", wx,wy,f.inscatter.at(wx,wy).x, truth.at(wx,wy).x, tests::errorWhere(f.inscatter, truth, [](int x,int y){return x>0&&y>0&&x<95&&y<63;})); }
      std::printf("%d %d share %.3f reused-full max %.2e rrmse %.2e  err full %.4f reused %.4f unnamed %.4f exact named/not %.2e\n", (int)kind, i, p.share,
                  tests::difference(p.answer.inscatter, f.inscatter), tests::errorWhere(p.answer.inscatter, f.inscatter, [](int,int){return true;}),
                  tests::errorWhere(f.inscatter, truth, [](int,int){return true;}), tests::errorWhere(p.answer.inscatter, truth, [](int,int){return true;}),
                  tests::errorWhere(unnamed.inscatter, truth, [](int,int){return true;}), tests::difference(truth, unnamedExact.inscatter));
    }
  }
}
