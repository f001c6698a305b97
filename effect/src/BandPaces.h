// How long draws take in truth, as a part of what is estimated (plan/Bands.h): learned by their titles from timer
// queries of earlier frames.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace tyndall {

/// Nothing in it waits for the GPU, and it makes GL objects only while frames have more draws to learn from than those
/// before.
class BandPaces {
public:
  /// What is learned stays between these: a frame that happens to be cheap, or a clock that is wrong, must not make the
  /// next one's bands much longer than estimated.
  static constexpr double kLeast = 1.0 / 8, kMost = 16;

  explicit BandPaces(const gl::Functions& gl) : gl_(gl) {}

  /// Takes what the GPU has told by now.
  void beginFrame();

  /// What the estimates of that draw are to be multiplied by; 1 where nothing is known.
  double of(const std::string& title) const;

  /// Around the bands of a draw, each of which is estimated to take that many milliseconds.
  void begin(const std::string& title, double milliseconds, int bands);
  void endBand();

private:
  static constexpr int kIntervals = 8; // that bands are timed together in
  struct Watch {
    std::array<gl::Query, kIntervals + 1> queries;
    std::string title;
    double milliseconds = 0; // of an interval, as estimated
    int left = 0;            // bands still to be drawn
    int each = 1;            // bands of an interval
    std::size_t stamps = 0;
  };
  struct Frame {
    std::vector<Watch> watches;
    std::size_t used = 0;
  };

  bool isKnown(const Frame& frame) const;
  void learnFrom(Frame& frame);
  void stamp();
  double slowest(const Watch& watch) const;

  const gl::Functions& gl_;
  std::array<Frame, 4> frames_; // of the last frames: more than an engine has under way
  std::size_t frame_ = 0;
  Watch* current_ = nullptr;
  std::map<std::string, double> paces_;
};

} // namespace tyndall
