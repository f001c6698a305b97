// The list of cases: a JSON file.
#pragma once

#include <filesystem>
#include <optional>
#include <render/Options.h>
#include <string>
#include <vector>

namespace regress {

/// What a picture may differ by from its reference. Differences are relative to the mean of the reference.
struct Tolerance {
  double rRmse = 0.005;       ///< root of the mean squared difference of all channels
  double p99 = 0.005;         ///< 99th percentile of the pixels' differences
  double max = 1;             ///< the largest one
  double pixel = 0.02;        ///< from which on a pixel counts as another one
  double over = 0.002;        ///< share of such pixels
  std::optional<double> flip; ///< mean FLIP of the displayed pictures; none: not judged
};

struct Case {
  std::string name;               ///< of letters, digits, - _ and ., unique in the list
  std::vector<std::string> words; ///< options as for tyndall-render, --name or --name=value
  render::Options options;        ///< the same, parsed
  Tolerance tolerance;
};

/// Relative names of scenes start from `scenes`, those of media from the list's folder. Throws host::Error, with a line
/// that names file, case, field and rule.
std::vector<Case> readCases(const std::filesystem::path& list, const std::filesystem::path& scenes);

/// Those whose name the pattern is, in which * stands for any letters and ? for one. Throws render::UsageError if there
/// is none.
std::vector<Case> only(const std::vector<Case>& cases, const std::string& pattern);

std::vector<Case> shareOf(const std::vector<Case>& cases, const render::Share& share);

} // namespace regress
