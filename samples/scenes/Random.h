// PCG32 (O'Neill 2014): the same numbers on every machine, which the distributions of the standard library are not.
// C++ leaves the order of a call's arguments and of most operands open: draw at most one number an expression.
#pragma once

#include <cstdint>

namespace scenes {

class Random {
public:
  explicit Random(std::uint64_t seed) : state_(0) {
    next();
    state_ += seed;
    next();
  }

  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto turn = static_cast<std::uint32_t>(old >> 59U);
    return (shifted >> turn) | (shifted << ((32U - turn) & 31U));
  }

  /// In [0, 1).
  double unit() { return next() * (1.0 / 4294967296.0); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// In 0..count-1.
  int below(int count) { return static_cast<int>(unit() * count); }

private:
  std::uint64_t state_;
};

/// A number in [0, 1) that belongs to a lattice point.
inline double hashOf(int x, int y, int z = 0) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343U + static_cast<std::uint32_t>(y) * 0xd8163841U +
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fU;
  h ^= h >> 16U;
  h *= 0x7feb352dU;
  h ^= h >> 15U;
  h *= 0x846ca68bU;
  h ^= h >> 16U;
  return h * (1.0 / 4294967296.0);
}

} // namespace scenes
