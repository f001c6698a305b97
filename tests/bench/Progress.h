// The line on a terminal that says what runs, how far all is, and how long it will still take.
#pragma once

#include <chrono>
#include <string>

namespace bench {

class Progress {
public:
  /// Prints nothing if standard error is no terminal.
  explicit Progress(int units);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void begin(const std::string& what, int units);
  /// Takes the line away, so that something else can be printed.
  void clear() const;

private:
  int units_;
  int begun_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace bench
