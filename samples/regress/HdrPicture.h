// A picture as references hold it: linear RGB in half floats, row 0 on top.
#pragma once

#include <filesystem>
#include <render/RenderFrame.h>
#include <vector>

namespace regress {

struct HdrPicture {
  int width = 0;
  int height = 0;
  std::vector<float> rgb; ///< three a pixel, each a value that a half float holds
};

/// The composite of all rendered pixels. What is finite stays so: it is cut at the largest half float.
HdrPicture hdrOf(const render::Picture& picture, const render::Options& options);

/// Throws host::Error.
void writeHdr(const std::filesystem::path& file, const HdrPicture& picture);
HdrPicture readHdr(const std::filesystem::path& file);

/// The exposure that the options ask for, or else the picture's own.
float exposureOf(const HdrPicture& picture, const render::Options& options);

} // namespace regress
