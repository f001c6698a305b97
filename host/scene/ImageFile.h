// EXR and PNG files. Row 0 of every image here is the top row, as in the files; GL's row 0 is the bottom row, so what
// glReadPixels returns has to be flipped. Files are written beside their name and renamed: never half a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace host {

struct Channel {
  std::string name;          ///< as in the EXR: R, inscatter.G, Z, ...
  std::vector<float> values; ///< width * height, row 0 on top
};

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;

  const std::vector<float>* find(const std::string& name) const; ///< null if there is no such channel

  /// Adds every `stride`-th float of interleaved pixels, from `offset` on, as a channel.
  /// bottomUp: the first row of `pixels` is the bottom one, as glReadPixels gives it.
  void addChannel(const std::string& name, const float* pixels, int stride, int offset, bool bottomUp);
};

enum class Precision { Float, Half };

/// 32-bit float, ZIP-compressed scanlines, or half floats, PIZ-compressed. Throws Error if the image is malformed or
/// cannot be written.
void writeExr(const std::filesystem::path& file, const Image& image, Precision precision = Precision::Float);

/// The value as an EXR of half floats holds it; what is too large becomes infinite.
float roundedToHalf(float value);

/// All channels as 32-bit float, in the file's (alphabetical) order. Throws Error.
Image readExr(const std::filesystem::path& file);

/// 8-bit sRGB, three bytes a pixel, row 0 on top. Throws Error.
void writePng(const std::filesystem::path& file, int width, int height, const std::vector<std::uint8_t>& rgb8);

/// Whether the file is a PNG of this size that can be read to its end.
bool isWholePng(const std::filesystem::path& file, int width, int height);

/// How radiance becomes what a screen shows.
enum class Tone {
  Film,     ///< a filmic curve; hues hold while highlights fade to white
  Reinhard, ///< x / (1 + x) of the brightest channel
  Clip,     ///< cut off at 1
};

/// Linear radiance, three floats a pixel, to sRGB bytes in the same order: exposure, the curve, the sRGB transfer
/// function. A pixel with a NaN becomes magenta.
/// The result has width x height pixels, each the mean of supersample x supersample pixels of `rgb` after the curve, as
/// a display would show them: bright edges are smooth, too.
std::vector<std::uint8_t> toneMap(const float* rgb, int width, int height, float exposure = 1, int supersample = 1,
                                  Tone tone = Tone::Film);

/// The same for colours that mean numbers: cut off at 0 and 1, the sRGB transfer function, no exposure, no curve.
std::vector<std::uint8_t> encodeColours(const float* rgb, int width, int height, int supersample = 1);

} // namespace host
