#include "Quality.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viewer {

namespace {

struct Level {
  double scale; ///< of the picture's sides
  tyndall::Profile profile;
  int shadowSize; ///< at most
};

constexpr std::array<Level, 7> kLevels = {{
    {1, tyndall::Profile::High, tyndall::kMaxImageSize},
    {1, tyndall::Profile::Balanced, 2048},
    {0.75, tyndall::Profile::Balanced, 1024},
    {0.5, tyndall::Profile::Performance, 1024},
    {0.375, tyndall::Profile::Performance, 512},
    {0.25, tyndall::Profile::Performance, 512},
    {0.1875, tyndall::Profile::Performance, 256},
}};

int scaled(int pixels, double scale) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); }

bool isSampled(tyndall::DebugView view) {
  return view != tyndall::DebugView::Inscatter && view != tyndall::DebugView::Transmittance &&
         view != tyndall::DebugView::Inputs && view != tyndall::DebugView::Difference;
}

/// What costs as much as it may is brought down to the profile.
void hasten(tyndall::Settings& settings, tyndall::Profile profile) {
  const tyndall::Settings fast = tyndall::settingsOf(profile);
  const bool isView = settings.debugView != tyndall::DebugView::Composite && isSampled(settings.debugView);
  if (!isView) settings.technique = fast.technique;
  settings.slices = std::min(settings.slices, fast.slices);
  settings.samples = std::min(settings.samples, fast.samples);
  settings.rowStep = std::max(settings.rowStep, fast.rowStep);
  settings.breakThreshold = std::max(settings.breakThreshold, fast.breakThreshold);
  settings.bendThreshold = std::max(settings.bendThreshold, fast.bendThreshold);
  settings.leastWeight = std::min(settings.leastWeight, fast.leastWeight);
  settings.spreadThreshold = fast.spreadThreshold;
  settings.errorTarget = std::max(settings.errorTarget, fast.errorTarget);
  settings.minMaxTree = true;
  if (settings.debugView == tyndall::DebugView::Difference) settings.debugView = tyndall::DebugView::Composite;
}

} // namespace

int qualityLevels() { return static_cast<int>(kLevels.size()); }

settings::State atLevel(const settings::State& state, int level) {
  if (level <= 0) return state;
  const Level& row = kLevels[static_cast<std::size_t>(std::min(level, qualityLevels() - 1))];
  settings::State fast = state;
  fast.width = scaled(state.width, row.scale);
  fast.height = scaled(state.height, row.scale);
  fast.supersample = 1;
  fast.msaa = 1;
  fast.shadowSize = std::min(state.shadowSize, row.shadowSize);
  hasten(fast.settings, row.profile);
  return fast;
}

void Quality::drew(double milliseconds) {
  constexpr double kTooSlow = 1.15, kFast = 0.5;
  constexpr int kPatience = 8;
  if (milliseconds > kTooSlow * target_) {
    level_ = std::min(level_ + (milliseconds > 3 * target_ ? 2 : 1), qualityLevels() - 1);
    fastFrames_ = 0;
    return;
  }
  fastFrames_ = milliseconds < kFast * target_ ? fastFrames_ + 1 : 0;
  if (fastFrames_ < kPatience || level_ == 0) return;
  --level_;
  fastFrames_ = 0;
}

} // namespace viewer
