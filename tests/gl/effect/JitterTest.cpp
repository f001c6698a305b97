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
  void set(const Jitter& jitter, bool named = true, bool floats = true) {
    Frame& frame = rig_.scene.frame;
    const glm::dvec3 ndc(2 * jitter[0] / frame.viewport.width, 2 * jitter[1] / frame.viewport.height, 0);
    frame.camera.clipFromView = tests::toMat4(glm::translate(glm::dmat4(1), ndc) * reference::toMat4(still_));
    for (double& entry : frame.camera.clipFromView) // as most engines hold them
      if (floats) entry = static_cast<double>(static_cast<float>(entry));
    frame.camera.jitter = named ? jitter : Jitter{0, 0};
    rig_.look(frame.camera.viewFromWorld); // which renders depth anew
  }

private:
  tests::ShaftRig& rig_;
  Mat4 still_;
};

bool everywhere(int, int) { return true; }

tests::ShaftRig lit(LightKind kind, ShadowFilter filter = ShadowFilter::Nearest, int width = 96, int height = 64) {
  tests::ShaftRig rig(width, height);
  rig.addLight(kind == LightKind::Directional ? sun() : kind == LightKind::Spot ? spot() : point(), 128);
  rig.scene.frame.settings.shadowFilter = filter;
  rig.scene.frame.settings.technique = Technique::Epipolar;
  rig.scene.frame.lights[0].shadow.version = 1;
  return rig;
}

// The frame in full, by a technique; leaves the history alone.
reference::Image fullBy(tests::ShaftRig& rig, Technique technique) {
  const Technique own = rig.scene.frame.settings.technique;
  rig.scene.frame.settings.technique = technique;
  reference::Image image = full(rig).inscatter;
  rig.scene.frame.settings.technique = own;
  return image;
}

// Mean and standard deviation of each value over frames.
struct Moments {
  reference::Image mean, deviation;
};

Moments momentsOf(const std::vector<reference::Image>& frames) {
  Moments moments{frames.front(), frames.front()};
  for (std::size_t i = 0; i < moments.mean.rgb.size(); ++i) {
    double sum = 0, squares = 0;
    for (const reference::Image& frame : frames) {
      const double value = static_cast<double>(frame.rgb[i]);
      sum += value;
      squares += value * value;
    }
    const auto count = static_cast<double>(frames.size());
    moments.mean.rgb[i] = static_cast<float>(sum / count);
    moments.deviation.rgb[i] =
        static_cast<float>(std::sqrt(std::max(squares / count - sum / count * sum / count, 0.0)));
  }
  return moments;
}

// Root mean square of a picture as a part of another's mean.
double sizeOf(const reference::Image& image, const reference::Image& mean) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    squares += static_cast<double>(image.rgb[i]) * static_cast<double>(image.rgb[i]);
    sum += static_cast<double>(mean.rgb[i]);
  }
  const auto count = static_cast<double>(image.rgb.size());
  return std::sqrt(squares / count) / (sum / count);
}

// The picture of exact with 4 x 4 rays a pixel.
reference::Image supersampled(LightKind kind, ShadowFilter filter) {
  tests::ShaftRig rig(4 * 96, 4 * 64);
  const tests::ShaftRig small = lit(kind, filter);
  rig.addLight(small.scene.frame.lights[0], 128);
  rig.scene.frame.settings.shadowFilter = filter;
  const reference::Image fine = rig.picture(Technique::Exact);
  reference::Image mean{96, 64, std::vector<float>(3 * 96 * 64, 0)};
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x)
      for (int c = 0; c < 3; ++c)
        mean.rgb[static_cast<std::size_t>(3 * (96 * (y / 4) + x / 4) + c)] += static_cast<float>(fine.at(x, y)[c] / 16);
  return mean;
}

} // namespace

TEST_CASE(
    "by exact a jitter that is named and one that is not are the same picture, and so they are for every technique "
    "but for where slices lie") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
    CAPTURE(static_cast<int>(kind));
    tests::ShaftRig rig = lit(kind);
    JitteredCamera camera(rig);
    const std::vector<Technique> techniques = {Technique::Epipolar, Technique::Tree, Technique::LowRank};
    std::vector<double> still;
    for (const Technique technique : techniques)
      still.push_back(tests::errorWhere(fullBy(rig, technique), fullBy(rig, Technique::Exact), everywhere));
    for (const Jitter& jitter : {Jitter{0.31, -0.45}, Jitter{0.9, 0.2}, Jitter{-5.25, 3.5}, Jitter{16, -16}}) {
      CAPTURE(jitter[0], jitter[1]);
      camera.set(jitter, false);
      const reference::Image truth = fullBy(rig, Technique::Exact);
      camera.set(jitter);
      CHECK(tests::errorWhere(fullBy(rig, Technique::Exact), truth, everywhere) <= 5e-5); // floats of 0 to 96 pixels
      for (std::size_t i = 0; i < techniques.size(); ++i)
        CHECK(tests::errorWhere(fullBy(rig, techniques[i]), truth, everywhere) <= 1.7 * still[i]);
    }
  }
}

TEST_CASE("whole pixels of jitter move the picture by whole pixels", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
    CAPTURE(static_cast<int>(kind));
    tests::ShaftRig rig = lit(kind, ShadowFilter::Nearest, 256, 192);
    JitteredCamera camera(rig);
    camera.set({1, 0}, true, false);
    const reference::Image before = fullBy(rig, Technique::Epipolar);
    camera.set({4, -2}, true, false);
    const reference::Image after = fullBy(rig, Technique::Epipolar);
    constexpr int kInner = 56; // three segments from what only one of the two sees
    int off = 0;
    for (int y = kInner; y < before.height - kInner; ++y)
      for (int x = kInner; x < before.width - kInner; ++x) {
        const glm::dvec3 expected = before.at(x - 3, y + 2);
        if (glm::length(after.at(x, y) - expected) > 1e-4 * glm::length(expected)) ++off;
      }
    CHECK(off <= 115); // of 11520: samples between two pixels, which see the other one by rounding
  }
}

TEST_CASE("over Halton's points the mean is the supersampled picture, and no pixel flickers more than it must",
          "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CAPTURE(static_cast<int>(kind), static_cast<int>(filter));
      tests::ShaftRig rig = lit(kind, filter);
      const double still =
          tests::errorWhere(fullBy(rig, Technique::Epipolar), fullBy(rig, Technique::Exact), everywhere);
      JitteredCamera camera(rig);
      std::vector<reference::Image> frames, truths;
      for (int i = 0; i < kFrames; ++i) {
        camera.set(halton(i));
        frames.push_back(fullBy(rig, Technique::Epipolar));
        truths.push_back(fullBy(rig, Technique::Exact));
      }
      const Moments drawn = momentsOf(frames), exact = momentsOf(truths);
      const double meanError = tests::errorWhere(drawn.mean, exact.mean, everywhere);
      const reference::Image fine = supersampled(kind, filter);
      const double fineError = tests::errorWhere(drawn.mean, fine, everywhere),
                   least = tests::errorWhere(exact.mean, fine, everywhere);
      const double deviation = sizeOf(drawn.deviation, exact.mean), must = sizeOf(exact.deviation, exact.mean);
      CHECK(meanError <= still);
      CHECK(fineError <= least + still);
      CHECK(deviation <= 1.02 * must);
    }
}

TEST_CASE("a jitter alone marches nothing anew, whatever it is and when it rests") {
  tests::ShaftRig rig = lit(LightKind::Directional);
  JitteredCamera camera(rig);
  begin(rig, Changes::Objects);
  for (int i = 0; i < kFrames; ++i) {
    CAPTURE(i);
    camera.set(i == 5 ? Jitter{0, 0} : halton(i));
    ++rig.scene.frame.reuse.frame;
    CHECK(reused(rig).share == (i == 0 ? 1 : 0));
  }
  camera.set({0.8, 0});
  ++rig.scene.frame.reuse.frame;
  CHECK(reused(rig).share == 1); // other slices
}

TEST_CASE("with jitter a frame that reuses is the frame in full but for where depth was sampled", "[sweep]") {
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point}) {
      CAPTURE(static_cast<int>(changes), static_cast<int>(kind));
      tests::ShaftRig rig = lit(kind);
      JitteredCamera camera(rig);
      begin(rig, changes);
      rig.scene.frame.lights[0].shadow.version = 0;
      double sum = 0, worst = 0, kept = 0, anew = 0;
      for (int i = 0; i < kFrames; ++i) {
        moveTo(rig, i / 4); // every fourth frame
        if (i % 4 != 0) rig.scene.frame.objects.clear();
        camera.set(halton(i));
        const Picture picture = reused(rig);
        if (i > 0) sum += picture.share / (kFrames - 1);
        const reference::Image inFull = full(rig).inscatter, truth = fullBy(rig, Technique::Exact);
        worst = std::max(worst, tests::errorWhere(picture.answer.inscatter, inFull, everywhere));
        kept += tests::errorWhere(picture.answer.inscatter, truth, everywhere) / kFrames;
        anew += tests::errorWhere(inFull, truth, everywhere) / kFrames;
      }
      CHECK(sum < 0.5);
      CHECK(worst <= 0.01);
      CHECK(kept <= 1.1 * anew);
    }
}

TEST_CASE("what has changed is seen through a jitter: a surface that creeps is followed") {
  tests::ShaftRig rig = lit(LightKind::Directional);
  JitteredCamera camera(rig);
  begin(rig, Changes::Detect);
  for (int i = 0; i < kFrames; ++i) { // a wall before the camera, each frame a little nearer
    const glm::dmat4 wall = glm::translate(glm::dmat4(1), glm::dvec3(0, 2, -5 + 0.05 * i));
    rig.setMoving({glm::scale(wall, glm::dvec3(2, 1.5, 0.1))});
    rig.scene.frame.lights[0].shadow.version = 1; // the shadow's is not the question
    camera.set(halton(i));
    const Picture picture = reused(rig);
    const double error = tests::errorWhere(picture.answer.inscatter, full(rig).inscatter, everywhere);
    CAPTURE(i, picture.share, error);
    CHECK(error <= 0.01);
  }
}
