// One way of adding light to a picture: settings, an effect of its own, its textures, and what it cost.
#pragma once

#include "Bands.h"

#include <gl/RenderTargets.h>
#include <memory>
#include <tyndall/tyndall.h>

namespace viewer {

class Way {
public:
  /// Throws host::Error.
  explicit Way(const tyndall::Config& config);

  /// Draws all of it. The frame's own settings, targets and viewport are filled in. False: Config::betweenDraws did not
  /// want the rest. Throws host::Error.
  bool draw(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings);

  /// The same for Technique::Exact in steps that take about so long, and end before the next one: begin, then step
  /// until it is whole. Parts are drawn by cropped projections: rounded otherwise than the whole.
  void begin(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings);
  tyndall::Rectangle step(double milliseconds); ///< what it has drawn
  bool isWhole() const { return bands_.isDone(); }
  double share() const { return bands_.share(); }

  int width() const { return composite_ ? composite_->width() : 0; }
  int height() const { return composite_ ? composite_->height() : 0; }
  const host::RenderTargets& targets() const { return *composite_; } ///< colour and depth, none multisampled
  GLuint composite() const { return composite_ ? composite_->colour() : 0; }
  GLuint inscatter() const { return inscatter_.name(); }
  GLuint transmittance() const { return transmittance_.name(); }

  /// Of the last frame: what the effect did, and its wall time.
  const tyndall::Statistics& statistics() const { return statistics_; }
  double milliseconds() const { return milliseconds_; }
  void leaveOut(double milliseconds) { milliseconds_ -= milliseconds; } ///< that were not spent on it
  bool hasCompiled() const { return hasCompiled_; }                     ///< programs, in the last frame
  const tyndall::Frame& frame() const { return frame_; }                ///< as it was drawn

private:
  void prepare(const host::RenderTargets& surfaces, tyndall::Frame frame, const tyndall::Settings& settings);
  void copySurfaces(const host::RenderTargets& surfaces) const;
  /// False: given up.
  bool render(const tyndall::Frame& frame);

  std::unique_ptr<tyndall::Effect> effect_;
  std::unique_ptr<host::RenderTargets> composite_;
  host::GlTexture inscatter_, transmittance_;
  tyndall::Frame frame_;
  tyndall::Statistics statistics_;
  double milliseconds_ = 0, renderMilliseconds_ = 0; ///< of all steps, of the last one
  int programs_ = 0;                                 ///< compiled so far
  bool hasCompiled_ = false;
  Bands bands_;
  Pace pace_;
};

} // namespace viewer
