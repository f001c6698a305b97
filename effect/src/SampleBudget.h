// How the samples of a frame are dealt out among its lights (Settings::sampleBudget).
#pragma once

#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// The frame's settings for each light, with slices and samples by what the light is worth: the brightness that it adds
/// times the root of the share of the image that it covers, which makes the squared error least if it falls as samples
/// grow. `drawn` tells which lights are; the others keep the frame's and do not count. Technique::Epipolar only. No
/// light gets more than the frame's own slices x samples, nor fewer than kLeastSamples.
std::vector<Settings> dealSamples(const Frame& frame, const std::vector<bool>& drawn);

inline constexpr int kLeastSamples = 64 * 64; ///< slices x samples of a light

} // namespace tyndall
