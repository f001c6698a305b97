// The command line of tyndall-bench.
#pragma once

#include "Plan.h"

#include <filesystem>

namespace bench {

struct Options {
  std::vector<Setup> setups;
  int runs = 5;
  double secondsOfRuns = std::numeric_limits<double>::infinity();
  bool mapExact = false;
  bool sceneExact = false;
  bool floors = false;
  bool calls = false;
  bool plots = false;
  std::filesystem::path out;   ///< empty: print only
  std::filesystem::path cache; ///< empty: keep no references
};

/// Throws render::UsageError or render::Answer. Makes the output folder of --all if none is named.
Options parseOptions(int argc, const char* const* argv);

} // namespace bench
