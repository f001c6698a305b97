// What tyndall-avsm-bench measures of a method, and the forms it is written in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace avsmbench {

struct Row {
  std::string scene, method;
  double error = 0;               ///< mean absolute error of transmittance
  std::uint64_t bytes = 0;        ///< kept
  std::uint64_t listBytes = 0;    ///< of lists that it needs to be built
  double build = 0, lookUp = 0;   ///< milliseconds, medians; 0 if not timed
  double ownLookUp = 0;           ///< with the method's own filter, 0 if it has none
  double ratio = 0, ownRatio = 0; ///< of build and look-up to the baseline's of the same runs, medians
};

void printMarkdown(const std::vector<Row>& rows);
/// Throws host::Error if the file cannot be written.
void writeCsv(const std::string& path, const std::vector<Row>& rows);

} // namespace avsmbench
