// The profiles, one row each.
#include <tyndall/tyndall.h>

namespace tyndall {

Settings settingsOf(Profile profile) {
  struct Row {
    Technique technique;
    ShadowFilter filter;
    int slices, samples, rowStep;
    float breakThreshold, bendThreshold, leastWeight;
  };
  constexpr Row kRows[] = {
      {Technique::Epipolar, ShadowFilter::Nearest, 576, 192, 4, 0.08F, 0.05F, 0.001F}, // performance
      {Technique::Epipolar, ShadowFilter::Nearest, 768, 256, 3, 0.06F, 0.03F, 0.002F}, // balanced
      {Technique::Epipolar, ShadowFilter::Nearest, 1152, 512, 1, 0.04F, 0.02F, 0.01F}, // high
      {Technique::Exact, ShadowFilter::Nearest, 1152, 512, 1, 0.04F, 0.02F, 0.01F},    // reference
  };
  const Row& row = kRows[static_cast<int>(profile)];
  Settings settings;
  settings.technique = row.technique;
  settings.shadowFilter = row.filter;
  settings.slices = row.slices;
  settings.samples = row.samples;
  settings.rowStep = row.rowStep;
  settings.breakThreshold = row.breakThreshold;
  settings.bendThreshold = row.bendThreshold;
  settings.leastWeight = row.leastWeight;
  return settings;
}

} // namespace tyndall
