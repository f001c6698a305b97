// Runs the techniques of a setup on one frame, interleaved, and judges what they draw.
#pragma once

#include "ReferenceCache.h"
#include "Result.h"

#include <atomic>

namespace bench {

struct MeasureOptions {
  std::string scenesFolder;
  int runs = 5;
  double secondsOfRuns = std::numeric_limits<double>::infinity(); ///< after three and so long no more are timed
  bool mapExact = false;                                          ///< judge against it as well
  bool sceneExact = false;
  bool floors = false;                     ///< of the passes of ours
  bool calls = false;                      ///< what render() takes of the processor
  const std::atomic<bool>* stop = nullptr; ///< set by Ctrl-C: end soon, keep what is finished
};

/// Called when something begins: a text for the progress line, and how many of the setup's units of work it is.
using Report = std::function<void(const std::string& what, int units)>;

/// Units of work of a setup: a warm-up, the runs and the passes of each technique.
inline int unitsOf(const Setup& setup, int runs) { return static_cast<int>(setup.techniques.size()) * (runs + 2); }

/// One result a technique, in order; fewer if stopped. Never throws host::Error: what fails is in the results.
std::vector<Result> measure(const Setup& setup, const MeasureOptions& options, const ReferenceCache& cache,
                            const Report& report);

} // namespace bench
