#include "HdrPicture.h"

#include <algorithm>
#include <cmath>
#include <render/Outputs.h>
#include <scene/Error.h>
#include <scene/ImageFile.h>

namespace regress {

namespace {

constexpr float kLargestHalf = 65504;
constexpr const char* kChannels[] = {"R", "G", "B"};

} // namespace

HdrPicture hdrOf(const render::Picture& picture, const render::Options& options) {
  HdrPicture hdr{render::renderedWidth(options), render::renderedHeight(options), {}};
  hdr.rgb = render::topDownRgb(picture.composite, hdr.width, hdr.height);
  for (float& value : hdr.rgb)
    value = host::roundedToHalf(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
  return hdr;
}

void writeHdr(const std::filesystem::path& file, const HdrPicture& picture) {
  host::Image image;
  image.width = picture.width;
  image.height = picture.height;
  for (int channel = 0; channel < 3; ++channel)
    image.addChannel(kChannels[channel], picture.rgb.data(), 3, channel, false);
  host::writeExr(file, image, host::Precision::Half);
}

HdrPicture readHdr(const std::filesystem::path& file) {
  const host::Image image = host::readExr(file);
  HdrPicture picture{image.width, image.height, {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(image.width) * image.height);
  for (int channel = 0; channel < 3; ++channel) {
    const std::vector<float>* values = image.find(kChannels[channel]);
    if (!values) throw host::Error(file.string() + ": lacks channel " + kChannels[channel]);
    for (std::size_t i = 0; i < values->size(); ++i)
      picture.rgb[3 * i + channel] = (*values)[i];
  }
  return picture;
}

float exposureOf(const HdrPicture& picture, const render::Options& options) {
  if (options.exposureStops) return static_cast<float>(std::exp2(*options.exposureStops));
  render::Picture rendered;
  rendered.composite.reserve(picture.rgb.size() / 3 * 4);
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    rendered.composite.insert(rendered.composite.end(), picture.rgb.begin() + i, picture.rgb.begin() + i + 3);
    rendered.composite.push_back(1);
  }
  return render::exposureOf(rendered);
}

} // namespace regress
