// A camera that turns by 0.1 degrees a frame, all the way round: the error of technique epipolar stays even while the
// sun crosses the edges of the screen and the plane of the eye. The curve is written to turning-<name>.csv.
#include "ShaftRig.h"
#include "reference/CameraRays.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kFrames = 3600;
constexpr int kWindow = 6;  // frames on either side of a crossing that are all rendered
constexpr int kStride = 15; // elsewhere

struct Turn {
  std::string name;
  glm::dvec3 axis;           // in view space
  double elevation, azimuth; // of the sun above the horizon and beside the view axis of frame 0, degrees
};

// Yaw takes the sun across the left and right edge, pitch across the bottom and top edge.
const std::vector<Turn> kTurns = {{"yaw", {0, 1, 0}, 14, 0}, {"pitch", {1, 0, 0}, 20, 17}};

glm::dvec3 sunDirection(const Turn& turn) { // towards the sun
  const double e = glm::radians(turn.elevation), a = glm::radians(turn.azimuth);
  return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

glm::dmat4 viewOf(const Turn& turn, int frame) {
  return glm::rotate(glm::dmat4(1), glm::radians(0.1 * frame), turn.axis) *
         glm::translate(glm::dmat4(1), glm::dvec3(0, -2, 0));
}

// On which side of each edge and of the eye's plane the sun is.
int placeOf(const Turn& turn, int frame, const Mat4& clipFromView) {
  const glm::dvec4 clip = reference::toMat4(clipFromView) * viewOf(turn, frame) * glm::dvec4(sunDirection(turn), 0);
  if (clip.w <= 0) return 0;
  return 1 + (clip.x < -clip.w ? 1 : 0) + (clip.x > clip.w ? 2 : 0) + (clip.y < -clip.w ? 4 : 0) +
         (clip.y > clip.w ? 8 : 0);
}

// All frames about a crossing, every kStride-th elsewhere.
std::vector<int> framesOf(const Turn& turn, const Mat4& clipFromView) {
  std::vector<bool> wanted(kFrames, false);
  for (int i = 0; i < kFrames; i += kStride)
    wanted[static_cast<std::size_t>(i)] = true;
  for (int i = 0; i < kFrames; ++i)
    if (placeOf(turn, i, clipFromView) != placeOf(turn, i + 1, clipFromView))
      for (int j = i - kWindow + 1; j <= i + kWindow; ++j)
        wanted[static_cast<std::size_t>((j + kFrames) % kFrames)] = true;
  std::vector<int> frames;
  for (int i = 0; i < kFrames; ++i)
    if (wanted[static_cast<std::size_t>(i)]) frames.push_back(i);
  return frames;
}

struct Point {
  int frame, place;
  double mean, rRmse, p99;
};

class TurningRig {
public:
  explicit TurningRig(const Turn& turn) : turn_(turn) {
    Light sun = tests::shaftLight(LightKind::Directional);
    const glm::dvec3 direction = -sunDirection(turn);
    sun.direction = {direction.x, direction.y, direction.z};
    rig_.addLight(sun, 256);
    clipFromView_ = rig_.scene.frame.camera.clipFromView;
  }

  std::vector<Point> curve() {
    std::vector<Point> points;
    for (const int i : framesOf(turn_, clipFromView_)) {
      const reference::Image image = picture(i);
      const reference::ErrorMetrics error = reference::compare(image, rig_.truth());
      points.push_back({i, placeOf(turn_, i, clipFromView_), error.mean, error.rRmse, error.p99});
    }
    return points;
  }

  // What half a pixel changes in a frame: a shadow's edge that lies along a slice moves by as much at once.
  double displaced(int frame) { return rig_.error(picture(frame)).displaced; }

private:
  reference::Image picture(int frame) {
    rig_.look(tests::toMat4(viewOf(turn_, frame)));
    return rig_.picture(Technique::Epipolar);
  }

  const Turn& turn_;
  tests::ShaftRig rig_;
  Mat4 clipFromView_{};
};

void writeCurve(const std::string& name, const std::vector<Point>& curve) {
  std::ofstream file(name);
  file << "frame,place,mean,rRMSE,p99\n";
  for (const Point& p : curve)
    file << p.frame << ',' << p.place << ',' << p.mean << ',' << p.rRmse << ',' << p.p99 << '\n';
}

// The frames with light: a picture that is nearly black has no scale for its error.
std::vector<Point> litFrames(std::vector<Point> curve) {
  double brightest = 0;
  for (const Point& p : curve)
    brightest = std::max(brightest, p.mean);
  curve.erase(std::remove_if(curve.begin(), curve.end(), [&](const Point& p) { return p.mean < 0.1 * brightest; }),
              curve.end());
  return curve;
}

// Of the evenly spaced frames: those about the crossings must not set the measure that they are held to.
double medianError(const std::vector<Point>& curve) {
  std::vector<double> errors;
  for (const Point& p : curve)
    if (p.frame % kStride == 0) errors.push_back(p.rRmse);
  REQUIRE(!errors.empty());
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

} // namespace

TEST_CASE("a turning camera sees no error that stands out and no jump", "[sweep]") {
  for (const Turn& turn : kTurns) {
    TurningRig rig(turn);
    const std::vector<Point> all = rig.curve(), curve = litFrames(all);
    writeCurve("turning-" + turn.name + ".csv", all);
    const double median = medianError(curve);
    CAPTURE(turn.name, median);
    CHECK(median > 1e-4); // or nothing was interpolated
    int neighbours = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      CAPTURE(curve[i].frame, curve[i].place, curve[i].mean, curve[i].p99);
      CHECK(curve[i].rRmse <= 3 * median);
      if (i == 0 || curve[i].frame != curve[i - 1].frame + 1) continue;
      ++neighbours;
      const double jump = std::abs(curve[i].rRmse - curve[i - 1].rRmse);
      CHECK((jump <= median || jump <= rig.displaced(curve[i].frame)));
    }
    CHECK(neighbours >= 2 * (2 * kWindow - 1)); // both edges at least
  }
}
