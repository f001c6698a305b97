// Processes that draw random frames, watched by one that outlives their crashes and hangs.
#pragma once

#include "Report.h"

#include <functional>
#include <optional>

namespace stress {

struct Plan {
  std::uint64_t first = 1;
  std::uint64_t count = 1000;
  double seconds = 0; ///< no seed is begun after so many; 0: all are drawn
  int jobs = 1;
  AxisSet simple;
  std::set<std::string> runs; ///< empty: all
  std::string pictures;       ///< folder for them; empty: nowhere
  bool shrink = true;
  bool loops = false;       ///< counts the turns of the shaders' loops
  double hangSeconds = 120; ///< of a frame without an end
};

/// Draws the seeds; `said` gets a line for each finding, as it is found.
Report run(const Plan& plan, const std::function<void(const std::string&)>& said);

} // namespace stress
