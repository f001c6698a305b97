// What one case measured.
#pragma once

#include "Calls.h"
#include "Floors.h"
#include "Plan.h"
#include "reference/Metrics.h"

#include <map>

namespace bench {

struct Result {
  Setup setup; ///< without its techniques
  Technique technique;
  std::string driver;
  std::size_t lightCount = 0;          ///< of the frame
  std::string skipped;                 ///< why the technique does not take the scene; empty if it ran
  std::string failed;                  ///< what went wrong; empty if nothing did
  std::vector<double> milliseconds;    ///< of each timed run, in order, by the wall clock around glFinish
  std::vector<double> gpuMilliseconds; ///< the same by GL's timestamps
  std::vector<tyndall::PassStatistics> passes;
  std::uint64_t bytes = 0; ///< GL memory of the technique
  std::optional<Counts> counts;
  std::vector<PassFloor> floors;                         ///< empty unless asked for and offered
  std::optional<CallTimes> calls;                        ///< none unless asked for, of ours
  std::uint64_t peakMemory = 0;                          ///< of the process while the setup ran, bytes
  std::map<std::string, reference::ErrorMetrics> errors; ///< against "exact", "map", "scene"

  bool ok() const { return skipped.empty() && failed.empty() && !milliseconds.empty(); }
  double median() const;
  double gpuMedian() const;
  double least() const;
  double most() const;
  double rRmse() const; ///< against exact; infinite if not known
};

} // namespace bench
