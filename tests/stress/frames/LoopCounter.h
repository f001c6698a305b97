// How often the loops of the effect's shaders turn: each is given a counter on its way to the compiler.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tyndall/tyndall.h>

namespace stress {

/// For effects that are created by its loader, in the test context. One at a time.
class LoopCounter {
public:
  LoopCounter();
  ~LoopCounter();
  LoopCounter(const LoopCounter&) = delete;
  LoopCounter& operator=(const LoopCounter&) = delete;

  static tyndall::GlLoader loader();

  /// The most turns since the last call: of a loop from its beginning to its end, by "function: header" (main's by its
  /// pass), and of all loops of one invocation, by the pass. Without those that did not turn. Waits for the GPU.
  std::map<std::string, std::uint32_t> take();

private:
  std::uint32_t buffer_ = 0;
};

/// A shader whose loops count their turns; compute shaders as they are. `slotOf` gives the place of a loop's or a
/// pass's most turns, `slots` is how many there are.
std::string countingSource(const std::string& source, int slots, int (*slotOf)(const std::string& name));

} // namespace stress
