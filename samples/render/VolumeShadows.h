// Adaptive volumetric shadow maps of a frame's lights: what smoke and strands let through.
#pragma once

#include <gl/SceneRenderer.h>
#include <memory>
#include <tyndall/avsm.h>
#include <vector>

namespace render {

/// One light's.
struct VolumeShadowStatistics {
  int light = 0;                  ///< index into Frame::lights
  double captureMilliseconds = 0; ///< wall time of the capture, begin() and resolve() apart
  tyndall::AvsmStatistics avsm;
};

class VolumeShadows {
public:
  VolumeShadows(tyndall::GlLoader loader, tyndall::PassTiming timing, int size, int nodes)
      : loader_(loader), timing_(timing), size_(size), nodes_(nodes) {}

  /// Captures the renderer's smoke and strands from each light with shadow views, and sets its curves. Throws
  /// host::Error.
  void update(host::SceneRenderer& renderer, std::vector<tyndall::Light>& lights);

  /// Of the last update(), for each light that has shadow views.
  std::vector<VolumeShadowStatistics> statistics() const;

private:
  struct Map {
    std::unique_ptr<tyndall::Avsm> avsm; ///< none for a light without shadow views
    int layers = 0;
    double captureMilliseconds = 0;
  };

  void update(host::SceneRenderer& renderer, tyndall::Light& light, Map& map) const;

  tyndall::GlLoader loader_;
  tyndall::PassTiming timing_;
  int size_;
  int nodes_;
  std::vector<Map> maps_;
};

} // namespace render
