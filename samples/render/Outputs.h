// Pictures and statistics as files.
#pragma once

#include "Options.h"
#include "RenderFrame.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace render {

/// The composite as RGB, row 0 on top.
std::vector<float> topDownRgb(const std::vector<float>& bottomUpRgba, int width, int height);

/// The name of a frame's picture: %04d becomes the number.
std::filesystem::path nameOfFrame(const std::filesystem::path& pattern, int frame);

/// What brings the picture's geometric mean radiance, black left out, to middle grey, or less if the brightest fiftieth
/// would lose its contrast.
float exposureOf(const Picture& picture);

/// Whether one of the options' pictures depends on the exposure.
bool needsExposure(const Options& options);

/// 8-bit sRGB of the picture's size, row 0 on top, of the linear colours of all rendered pixels, three floats each, row
/// 0 on top: as the view asks for, radiance by the film curve.
std::vector<std::uint8_t> displayed(const std::vector<float>& rgb, const Options& options, float exposure);

/// Throws host::Error unless the file is an EXR or a PNG by its extension.
void requirePictureName(const std::filesystem::path& file);

/// Writes an EXR or a PNG, by the extension. Throws host::Error.
void writePicture(const std::filesystem::path& file, const Picture& picture, const Options& options, float exposure);

/// Whether the file is all of such a picture: of the size and with the channels that would be written.
bool isWholePicture(const std::filesystem::path& file, const Options& options);

struct FrameStatistics {
  int frame = 0;
  Measurement measurement;
};

/// One object, or with --frames an object a frame in a list under "frames". Throws host::Error.
void writeStatistics(const std::filesystem::path& file, const Options& options, const host::Context& context,
                     const std::vector<FrameStatistics>& frames);

} // namespace render
