// Adaptive volumetric shadow maps of a frame's lights, and of its eye: what smoke, fog and strands let through.
#pragma once

#include <functional>
#include <gl/SceneRenderer.h>
#include <memory>
#include <tyndall/avsm.h>
#include <vector>

namespace render {

/// One light's, or the eye's.
struct VolumeShadowStatistics {
  static constexpr int kEye = -1;
  int light = 0;                  ///< index into Frame::lights, or kEye
  double captureMilliseconds = 0; ///< wall time of the capture, begin() and resolve() apart
  tyndall::AvsmStatistics avsm;
};

class VolumeShadows {
public:
  VolumeShadows(tyndall::GlLoader loader, tyndall::PassTiming timing, int size, int nodes)
      : loader_(loader), timing_(timing), size_(size), nodes_(nodes) {}

  /// Banks of fog that are captured from now on, beside the renderer's smoke and strands.
  void setFog(std::vector<tyndall::AvsmVolume> fog) { fog_ = std::move(fog); }

  /// Captures the renderer's smoke and strands, and the fog, from each light with shadow views, and sets its curves.
  /// Throws host::Error.
  void update(host::SceneRenderer& renderer, std::vector<tyndall::Light>& lights);

  /// Captures the renderer's smoke, and the fog, before a camera, between two planes (tyndall::eyeLight()), finely if
  /// it is lit. Throws host::Error.
  tyndall::EyeCurves before(host::SceneRenderer& renderer, const tyndall::Camera& camera,
                            const tyndall::Rectangle& image, double nearDistance, double farDistance, bool isLit);

  /// From now on there is none.
  void forgetEye() { eye_ = {}; }

  /// Of the last update(), for each light that has shadow views, and of what is before the eye.
  std::vector<VolumeShadowStatistics> statistics() const;

private:
  struct Map {
    std::unique_ptr<tyndall::Avsm> avsm; ///< none for a light without shadow views
    int layers = 0, nodes = 0;
    double captureMilliseconds = 0;
  };

  void create(Map& map, int layers, int nodes) const;
  void capture(Map& map, const tyndall::Light& light, const std::function<void()>& draw) const;

  tyndall::GlLoader loader_;
  tyndall::PassTiming timing_;
  int size_;
  int nodes_;
  std::vector<Map> maps_;
  Map eye_;
  std::vector<tyndall::AvsmVolume> fog_;
};

} // namespace render
