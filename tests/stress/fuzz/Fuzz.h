// What the fuzz targets share. A target gives bytes to a reader: it answers, or throws host::Error with one line. Any
// other exception, and whatever a sanitizer finds, ends the process, and libFuzzer keeps the bytes.
#pragma once

#include "support/TemporaryFolder.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace fuzz {

/// Ends the process with the rule unless it holds.
inline void require(bool holds, const std::string& rule) {
  if (holds) return;
  std::fprintf(stderr, "BROKEN RULE: %s\n", rule.c_str());
  std::abort();
}

inline std::string textOf(const std::uint8_t* data, std::size_t size) { return {data, data + size}; }

/// The process's own folder.
inline const std::filesystem::path& folder() {
  static const tests::TemporaryFolder one;
  return one.path();
}

/// The bytes as a file of that name.
inline std::filesystem::path fileOf(const std::string& name, const std::uint8_t* data, std::size_t size) {
  std::filesystem::path file = folder() / name;
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  stream.flush();
  require(static_cast<bool>(stream), file.string() + " can be written");
  return file;
}

/// Calls read(). False where it throws an Error, whose message has to be one line.
template <typename Error, typename Read>
bool accepts(const Read& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    require(std::strlen(error.what()) > 0, "a message says something");
    require(std::strchr(error.what(), '\n') == nullptr, "a message is one line");
    return false;
  }
}

/// Numbers from bytes; 0 once these are used up.
class Numbers {
public:
  Numbers(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool isEmpty() const { return next_ >= size_; }
  std::uint8_t byte() { return isEmpty() ? std::uint8_t{0} : data_[next_++]; }
  bool flag() { return (byte() & 1) != 0; }
  int below(int count) { return (byte() << 8 | byte()) % count; }

  template <typename Number>
  Number raw() {
    std::uint8_t bytes[sizeof(Number)];
    for (std::uint8_t& one : bytes)
      one = byte();
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }

  /// Any double, but more often one that people write, of any power of ten that is in use, or a limit.
  double real() {
    const int way = byte() % 16;
    const double mantissa = (below(2001) - 1000) / 100.0;
    if (way == 0) return raw<double>();
    if (way == 1) return double{raw<float>()};
    if (way == 2) return kOdd[static_cast<std::size_t>(below(static_cast<int>(std::size(kOdd))))];
    if (way == 3) return mantissa * std::pow(10.0, below(80) - 40);
    if (way < 8) return static_cast<double>(below(21) - 10);
    return mantissa;
  }

private:
  static constexpr double kOdd[] = {
      0.0,   -0.0,   1e-45, -1e-45, 1e-38, 1e38, -1e38,    3.4e38,    3.5e38, 1e-308,    5e-324,
      1e308, -1e308, 1e-7,  1e7,    1e15,  1e-4, INFINITY, -INFINITY, NAN,    0.9999999, 1.5707963267948966};

  const std::uint8_t* data_;
  std::size_t size_, next_ = 0;
};

} // namespace fuzz

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
