// The command line of tyndall-bench.
#pragma once

#include "Plan.h"

#include <filesystem>
#include <stdexcept>

namespace bench {

struct Options {
  std::vector<Setup> setups;
  int runs = 5;
  bool mapExact = false;
  bool sceneExact = false;
  bool plots = false;
  std::filesystem::path out;   ///< empty: print only
  std::filesystem::path cache; ///< empty: keep no references
};

/// The command line breaks a rule: one line that names option, value and rule.
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// --help was asked for: the text to print.
struct Answer {
  std::string text;
};

/// Throws UsageError or Answer. Makes the output folder of --all if none is named.
Options parseOptions(int argc, const char* const* argv);

} // namespace bench
