#include "Memory.h"

#include <fstream>
#include <sstream>
#include <string>

namespace bench {

std::uint64_t peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t kibibytes = 0;
    if (words >> name >> kibibytes && name == "VmHWM:") return 1024 * kibibytes;
  }
  return 0;
}

void resetPeakMemory() { std::ofstream("/proc/self/clear_refs") << 5; }

} // namespace bench
