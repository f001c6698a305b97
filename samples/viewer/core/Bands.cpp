#include "Bands.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <scene/Projection.h>

namespace viewer {

tyndall::Frame croppedTo(const tyndall::Frame& frame, const tyndall::Rectangle& part) {
  const double width = frame.viewport.width, height = frame.viewport.height;
  tyndall::Frame cropped = frame;
  glm::dmat4 partFromWhole(1);
  partFromWhole[0][0] = width / part.width;
  partFromWhole[1][1] = height / part.height;
  partFromWhole[3][0] = (width - 2 * part.x) / part.width - 1;
  partFromWhole[3][1] = (height - 2 * part.y) / part.height - 1;
  cropped.camera.clipFromView = host::toMat4(partFromWhole * host::fromMat4(frame.camera.clipFromView));
  cropped.viewport = {frame.viewport.x + part.x, frame.viewport.y + part.y, part.width, part.height};
  cropped.depth.rectangle = cropped.viewport;
  return cropped;
}

double Bands::share() const { return height_ == 0 ? 1 : (row_ + static_cast<double>(column_) / width_) / height_; }

tyndall::Rectangle Bands::next(double pixels) {
  const int x = column_, y = row_;
  const int most = static_cast<int>(std::clamp(pixels, 1.0, 1e9));
  if (column_ == 0 && most >= width_) {
    const int rows = std::min(most / width_, height_ - row_);
    row_ += rows;
    return {0, y, width_, rows};
  }
  const int columns = std::min(most, width_ - column_);
  column_ += columns;
  if (column_ == width_) {
    column_ = 0;
    ++row_;
  }
  return {x, y, columns, 1};
}

void Pace::took(double pixels, double milliseconds) {
  const double measured = pixels / std::max(milliseconds, 0.01);
  const double change = std::clamp(measured / pixelsPerMillisecond_, 0.25, 2.0);
  pixelsPerMillisecond_ *= change;
}

} // namespace viewer
