// What render() takes of the processor, without a wait for what it asked for.
#pragma once

#include <tyndall/tyndall.h>

namespace bench {

/// Medians of calls in a GL that has nothing to do when they begin, milliseconds.
struct CallTime {
  double wall = 0;      ///< until it returns
  double processor = 0; ///< of the calling thread
};

struct CallTimes {
  CallTime restore, leave; ///< by state mode
};

/// Throws host::Error.
CallTimes callTimes(const tyndall::Settings& settings, tyndall::GlLoader loader, tyndall::Frame frame, int runs);

} // namespace bench
