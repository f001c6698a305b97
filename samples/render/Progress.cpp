#include "Progress.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <scene/Tool.h>
#include <unistd.h>

namespace render {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

} // namespace

Progress::Progress(int frameCount)
    : frameCount_(frameCount), shown_(frameCount > 1 && isatty(STDERR_FILENO) == 1), start_(now()) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) host::sayRaw("\n");
}

double Progress::secondsSinceStart() const { return now() - start_; }

void Progress::step(double effectMilliseconds) {
  ++done_;
  if (!shown_) return;
  const int left = static_cast<int>(std::lround(secondsSinceStart() / done_ * (frameCount_ - done_)));
  constexpr const char* kClearRestOfLine = "\x1b[K";
  host::sayRaw(fmt::format("\rframe {}/{}  {:.1f} ms  {:02d}:{:02d} left{}", done_, frameCount_, effectMilliseconds,
                           left / 60, left % 60, kClearRestOfLine));
}

} // namespace render
