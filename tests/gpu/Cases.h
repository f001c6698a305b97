// The cases of a Catch2 executable, each in a process of its own: one that crashes or hangs takes no other with it.
#pragma once

#include "Who.h"

#include <filesystem>

namespace gpu {

struct CasesOptions {
  std::filesystem::path program;
  std::filesystem::path out;       ///< cases.json and junit.xml; and cases/, a file of JUnit each
  std::vector<std::string> select; ///< as Catch2 takes it; empty: all, those that are slow last
  int jobs = 1;
  int secondsOfCase = 60;
};

/// Those that tell most of a driver first. Cases with a result in `out` are not run again, unless they took too long.
/// Returns the signal that ended it early, or 0.
int runCases(const CasesOptions& options);

} // namespace gpu
