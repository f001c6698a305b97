// Random numbers that a seed alone decides, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stress {

/// SplitMix64 (Steele et al. 2014).
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  int between(int low, int high) { return low + below(high - low + 1); } ///< both included
  bool chance(double probability) { return uniform() < probability; }

  template <typename Value>
  Value pick(const std::vector<Value>& values) {
    return values[static_cast<std::size_t>(below(static_cast<int>(values.size())))];
  }

private:
  std::uint64_t state_;
};

/// One number from two, spread over all bits.
inline std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  Random random(a ^ (b * 0xD6E8FEB86659FD93U));
  return random.next();
}

} // namespace stress
