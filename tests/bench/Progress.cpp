#include "Progress.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <scene/Tool.h>
#include <unistd.h>

namespace bench {

Progress::Progress(int units) : units_(std::max(units, 1)), shown_(isatty(STDERR_FILENO) == 1) {}

void Progress::begin(const std::string& what, int units) {
  constexpr int kWidth = 24;
  if (!shown_) return;
  const int done = std::min(begun_, units_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const std::string bar(static_cast<std::size_t>(kWidth * done / units_), '#');
  std::string left = "--:--";
  if (done > 0) {
    const int seconds = static_cast<int>(elapsed.count() / done * (units_ - done));
    left = fmt::format("{:02d}:{:02d}", seconds / 60, seconds % 60);
  }
  host::sayRaw(fmt::format("\r[{:<24}] {}/{}  {} left  {}\x1b[K", bar, done, units_, left, what));
  begun_ += units;
}

void Progress::clear() const {
  if (shown_) host::sayRaw("\r\x1b[K");
}

} // namespace bench
