// What a screen shows of pictures: exposure and curve, two of them beside each other, differences.
#pragma once

#include <gl/Objects.h>
#include <scene/ImageFile.h>

namespace viewer {

/// A picture and what its errors are measured against.
struct Shown {
  GLuint composite = 0;
  GLuint inscatter = 0;
  int width = 0, height = 0;
};

struct DisplayOptions {
  float exposure = 1;
  host::Tone tone = host::Tone::Film;
  bool areNumbers = false; ///< colours that mean numbers: neither exposure nor curve
  float wipe = 1;          ///< share of the width, from the left, that shows the first picture
  GLuint exact = 0;        ///< if any: what is shown is the inscatter less this one, as a part of its mean
  float exactMean = 1;
  float differenceScale = 0.1F; ///< part of the mean that is full red or blue
  float exactRows = 1;          ///< share of the height, from the bottom, that it holds
};

class Display {
public:
  Display();

  /// Draws into its texture of this size.
  void draw(const Shown& first, const Shown& second, const DisplayOptions& options, int width, int height);

  GLuint texture() const { return texture_.name(); } ///< GL_TEXTURE_2D, RGBA8, sRGB values, row 0 at the bottom
  int width() const { return width_; }
  int height() const { return height_; }

private:
  host::Program program_;
  host::GlTexture texture_;
  host::GlFramebuffer framebuffer_;
  host::GlVertexArray empty_;
  host::GlSampler smooth_, exact_; ///< of pictures of another size, and of the same
  int width_ = 0, height_ = 0;
};

} // namespace viewer
