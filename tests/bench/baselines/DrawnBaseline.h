// A baseline that draws by a Drawer.
#pragma once

#include "baselines/Baseline.h"
#include "baselines/Drawer.h"

namespace bench {

class DrawnBaseline : public Baseline {
public:
  std::string reasonAgainst(const tyndall::Frame& frame) const override {
    if (frame.depth.multisampled) return "takes one depth per pixel";
    return frame.settings.shadowFilter == tyndall::ShadowFilter::Nearest ? "" : "takes the shadow map unfiltered";
  }
  void render(const tyndall::Frame& frame) final {
    drawer_.beginFrame(frame);
    draw(frame);
    drawer_.endFrame();
  }
  std::vector<tyndall::PassStatistics> passes() const override { return drawer_.passes(); }
  void timePasses(bool timed) override { drawer_.timePasses(timed); }
  std::uint64_t bytes() const override { return drawer_.bytes(); }

protected:
  virtual void draw(const tyndall::Frame& frame) = 0;

  /// Why a technique for directional lights with one shadow view cannot render a frame; empty if it can.
  static std::string reasonAgainstManyViews(const tyndall::Frame& frame) {
    for (const tyndall::Light& light : frame.lights) {
      if (light.kind != tyndall::LightKind::Directional) return "takes directional lights only";
      if (light.shadow.views.size() > 1) return "takes one shadow view";
    }
    return {};
  }

  static bool hasGlass(const tyndall::Frame& frame) {
    for (const tyndall::Light& light : frame.lights)
      if (light.glass.colour != 0) return true;
    return false;
  }

  Drawer& drawer() { return drawer_; }
  const Drawer& drawer() const { return drawer_; }

private:
  Drawer drawer_;
};

/// " 0", " 1", …: behind the name of a pass that runs once for each light.
inline std::string lightSuffix(std::size_t light) { return " light " + std::to_string(light); }

} // namespace bench
