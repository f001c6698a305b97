// Many sequences, each batch of them in a process of its own: one that crashes or hangs is reported with its seed, and
// the others go on.
#pragma once

#include "Sequence.h"

#include <functional>

namespace stress {

struct Plan {
  std::uint64_t first = 1; ///< seeds, one after the other
  std::uint64_t count = 1;
  double seconds = 0;   ///< no sequence begins after them; 0: no limit
  int batch = 500;      ///< sequences of a process
  double patience = 60; ///< seconds that one sequence may take, first compilations included
  Recipe recipe;        ///< of all but the seed
  bool shrinks = true;
  bool describes = false; ///< prints each frame
};

struct Outcome {
  Tally tally;
  std::vector<std::string> failures; ///< a command line and what is wrong, each
  long failed = 0;
  double seconds = 0;
};

/// Prints failures as they come.
Outcome runBatches(const Plan& plan);

} // namespace stress
