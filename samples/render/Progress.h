// The line on a terminal that says how far a sequence is.
#pragma once

namespace render {

class Progress {
public:
  /// Prints nothing for a single frame, or if standard error is no terminal.
  explicit Progress(int frameCount);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A frame is done: its effect took so long.
  void step(double effectMilliseconds);

private:
  double secondsSinceStart() const;

  int frameCount_;
  int done_ = 0;
  bool shown_;
  double start_;
};

} // namespace render
