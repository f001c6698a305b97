// The 128-bit hash of Fowler, Noll and Vo (FNV-1a), of texts and bytes one after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tyndall::gl {

class Hash {
public:
  void add(const std::uint8_t* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      add(bytes[i]);
  }

  /// With its terminating zero, so that "a" and "bc" are not "ab" and "c".
  void add(const std::string& text) { add(reinterpret_cast<const std::uint8_t*>(text.c_str()), text.size() + 1); }

  std::uint64_t low() const { return low_; }

  /// 32 digits.
  std::string hex() const {
    std::string text;
    for (const std::uint64_t half : {high_, low_})
      for (int shift = 60; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[half >> shift & 15];
    return text;
  }

private:
  // Times the prime 2^88 + 0x13b.
  void add(std::uint8_t byte) {
    low_ ^= byte;
    const std::uint64_t lower = (low_ & 0xffffffff) * 0x13b;
    const std::uint64_t upper = (low_ >> 32) * 0x13b + (lower >> 32);
    high_ = high_ * 0x13b + (low_ << 24) + (upper >> 32);
    low_ = upper << 32 | (lower & 0xffffffff);
  }

  std::uint64_t high_ = 0x6c62272e07bb0142;
  std::uint64_t low_ = 0x62b821756295c58d;
};

} // namespace tyndall::gl
