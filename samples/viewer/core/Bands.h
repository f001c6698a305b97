// A picture that takes long, part by part: for the technique whose pixels do not depend on one another, Exact.
#pragma once

#include <tyndall/tyndall.h>

namespace viewer {

/// The frame that draws only this part of the viewport, into the same textures at the same place.
tyndall::Frame croppedTo(const tyndall::Frame& frame, const tyndall::Rectangle& part);

/// Deals out the rectangles of a picture, bottom row first.
class Bands {
public:
  Bands() = default;
  Bands(int width, int height) : width_(width), height_(height) {}

  bool isDone() const { return row_ >= height_; }
  double share() const; ///< that was dealt out
  /// Whole rows of about so many pixels, or a part of a row; the rest at most.
  tyndall::Rectangle next(double pixels);

private:
  int width_ = 0, height_ = 0;
  int row_ = 0, column_ = 0;
};

/// How many pixels a step may have so that it takes a time, from the steps before.
class Pace {
public:
  double pixelsFor(double milliseconds) const { return milliseconds * pixelsPerMillisecond_; }
  void took(double pixels, double milliseconds);

private:
  double pixelsPerMillisecond_ = 20; ///< at first, as a slow processor has it
};

} // namespace viewer
