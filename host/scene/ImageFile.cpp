#include "ImageFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <half.h>
#include <limits>
#include <list>
#include <png.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <set>
#include <tyndall/tyndall.h>

namespace host {

namespace {

constexpr std::uint64_t kMaxExrBytes = 4096ULL << 20;  // decoded
constexpr std::uint64_t kMaxExrLineBytes = 4ULL << 20; // decoded: OpenEXR keeps up to 256 lines at a time
constexpr int kLinesAtATime = 256;
constexpr std::uint64_t kMaxPngBytes = 4096ULL << 20;
constexpr std::size_t kMaxChannelName = 255; // of the EXR format

std::size_t pixelCount(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& rule) {
  throw Error(printable(file.string()) + ": " + printable(rule));
}

void checkSize(const std::filesystem::path& file, int width, int height) {
  const auto isSide = [](int side) { return side >= 1 && side <= tyndall::kMaxImageSize; };
  if (isSide(width) && isSide(height)) return;
  refuse(file, "the image is " + std::to_string(width) + " x " + std::to_string(height) + ", its sides must be 1 to " +
                   std::to_string(tyndall::kMaxImageSize));
}

void checkChannels(const std::filesystem::path& file, const Image& image) {
  if (image.channels.empty()) refuse(file, "the image has no channels");
  std::set<std::string> names;
  for (const Channel& channel : image.channels) {
    if (channel.name.empty() || channel.name.size() > kMaxChannelName || !names.insert(channel.name).second) {
      refuse(file, "channel \"" + channel.name + "\" must have a name of its own, 1 to 255 characters");
    }
    if (channel.values.size() != pixelCount(image.width, image.height)) {
      refuse(file, "channel \"" + channel.name + "\" must have a value for each pixel");
    }
  }
}

/// A slice of a frame buffer over a channel's values, float or half, whose window begins at `origin`.
template <typename Value>
Imf::Slice sliceOf(const Value* values, const Imath::V2i& origin, int width, int height) {
  constexpr Imf::PixelType kType = sizeof(Value) == sizeof(float) ? Imf::FLOAT : Imf::HALF;
  return Imf::Slice::Make(kType, values, origin, width, height, sizeof(Value), sizeof(Value) * width);
}

/// The ACES film curve as fitted by K. Narkowicz (2016), 0 at 0 and cut off at 1.
float filmic(float x) { return std::min(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F); }

/// IEC 61966-2-1.
std::uint8_t toSrgb8(float linear) {
  const float encoded = linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0F, 1.0F)));
}

/// The largest channel takes the film curve and the others keep their ratio to it, so that hues hold. What the curve
/// took off the peak then fades the colour to white, as in Khronos' PBR Neutral tone mapper.
/// Display-linear, 0 to 1.
glm::vec3 toneMapPixel(const float* rgb, float exposure, Tone tone) {
  constexpr float kBrightest = 1e6F; // keeps infinities out of the ratios
  constexpr float kDesaturation = 0.15F;
  float scaled[3];
  for (int c = 0; c < 3; ++c) {
    const float value = rgb[c] * exposure;
    if (std::isnan(value)) return {1, 0, 1};
    scaled[c] = std::clamp(value, 0.0F, kBrightest);
  }
  const float peak = std::max({scaled[0], scaled[1], scaled[2]});
  if (tone == Tone::Clip) return glm::min(glm::vec3(scaled[0], scaled[1], scaled[2]), 1.0F);
  if (tone == Tone::Reinhard) return glm::vec3(scaled[0], scaled[1], scaled[2]) / (1 + peak);
  const float mapped = filmic(peak);
  const float white = 1 - 1 / (kDesaturation * std::max(peak - mapped, 0.0F) + 1);
  glm::vec3 colour(0);
  for (int c = 0; c < 3; ++c) {
    const float pure = peak > 0 ? scaled[c] / peak * mapped : 0;
    colour[c] = pure + (mapped - pure) * white;
  }
  return colour;
}

/// sRGB bytes of display-linear colours, each the mean of supersample x supersample pixels.
template <typename Display>
std::vector<std::uint8_t> encode(const float* rgb, int width, int height, int supersample, const Display& display) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * pixelCount(width, height));
  const std::size_t rowLength = pixelCount(width, supersample);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
      glm::vec3 sum(0);
      for (int i = 0; i < supersample * supersample; ++i) {
        const std::size_t row = y * supersample + i / supersample;
        const std::size_t column = x * supersample + i % supersample;
        sum += display(rgb + 3 * (row * rowLength + column));
      }
      sum /= static_cast<float>(supersample * supersample);
      for (int c = 0; c < 3; ++c)
        bytes.push_back(toSrgb8(sum[c]));
    }
  return bytes;
}

} // namespace

const std::vector<float>* Image::find(const std::string& name) const {
  for (const Channel& channel : channels) {
    if (channel.name == name) return &channel.values;
  }
  return nullptr;
}

void Image::addChannel(const std::string& name, const float* pixels, int stride, int offset, bool bottomUp) {
  Channel channel{name, std::vector<float>(pixelCount(width, height))};
  for (int y = 0; y < height; ++y) {
    const int row = bottomUp ? height - 1 - y : y;
    const float* source = pixels + pixelCount(row, width) * static_cast<std::size_t>(stride) + offset;
    float* target = channel.values.data() + pixelCount(y, width);
    for (int x = 0; x < width; ++x) {
      target[x] = source[static_cast<std::ptrdiff_t>(x) * stride];
    }
  }
  channels.push_back(std::move(channel));
}

float roundedToHalf(float value) { return half(value); }

void writeExr(const std::filesystem::path& file, const Image& image, Precision precision) {
  checkSize(file, image.width, image.height);
  checkChannels(file, image);
  const bool isHalf = precision == Precision::Half;
  Imf::Header header(image.width, image.height);
  header.compression() = isHalf ? Imf::PIZ_COMPRESSION : Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frameBuffer;
  std::list<std::vector<half>> halves;
  for (const Channel& channel : image.channels) {
    header.channels().insert(channel.name, Imf::Channel(isHalf ? Imf::HALF : Imf::FLOAT));
    if (isHalf) halves.emplace_back(channel.values.begin(), channel.values.end());
    frameBuffer.insert(channel.name, isHalf ? sliceOf(halves.back().data(), {0, 0}, image.width, image.height)
                                            : sliceOf(channel.values.data(), {0, 0}, image.width, image.height));
  }
  writeAndRename(file, [&](const std::filesystem::path& temporary) {
    Imf::OutputFile output(temporary.c_str(), header);
    output.setFrameBuffer(frameBuffer);
    output.writePixels(image.height);
  });
}

namespace {

/// The size and the channels that a header tells, still without values, or Error if they are against a rule. OpenEXR
/// itself takes memory by whatever a header says as soon as its pixels are opened.
Image checkedHeader(const std::filesystem::path& file, const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  Image image;
  image.width = static_cast<int>(std::min(width, kMost));
  image.height = static_cast<int>(std::min(height, kMost));
  checkSize(file, image.width, image.height);
  const Imf::ChannelList& channels = header.channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw Error(std::string("channel ") + channel.name() + " is subsampled");
    }
    image.channels.push_back({channel.name(), {}});
  }
  const std::uint64_t line = image.channels.size() * pixelCount(image.width, 1) * sizeof(float);
  if (line > kMaxExrLineBytes || line * static_cast<std::uint64_t>(image.height) > kMaxExrBytes) {
    throw Error("its channels take more than " + std::to_string(kMaxExrLineBytes >> 20) + " MiB a line or " +
                std::to_string(kMaxExrBytes >> 20) + " MiB in all");
  }
  return image;
}

} // namespace

Image readExr(const std::filesystem::path& file) {
  Image image;
  try {
    Imf::MultiPartInputFile parts(file.c_str());
    image = checkedHeader(file, parts.header(0));
    const Imath::Box2i window = parts.header(0).dataWindow();
    Imf::InputPart input(parts, 0);
    Imf::FrameBuffer frameBuffer;
    for (Channel& channel : image.channels) {
      channel.values.reserve(pixelCount(image.width, image.height));
      frameBuffer.insert(channel.name, sliceOf(channel.values.data(), window.min, image.width, image.height));
    }
    input.setFrameBuffer(frameBuffer);
    // Memory is touched only for lines that the file does hold.
    for (int begin = 0; begin < image.height; begin += kLinesAtATime) {
      const int end = std::min(begin + kLinesAtATime, image.height);
      for (Channel& channel : image.channels)
        channel.values.resize(pixelCount(image.width, end));
      input.readPixels(window.min.y + begin, window.min.y + end - 1);
    }
  } catch (const std::exception& error) {
    refuse(file, std::string("cannot be read as an EXR: ") + error.what());
  }
  return image;
}

void writePng(const std::filesystem::path& file, int width, int height, const std::vector<std::uint8_t>& rgb8) {
  checkSize(file, width, height);
  if (rgb8.size() != 3 * pixelCount(width, height)) refuse(file, "the image must have three bytes for each pixel");
  writeAndRename(file, [&](const std::filesystem::path& temporary) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, temporary.c_str(), 0, rgb8.data(), 0, nullptr) == 0) throw Error(image.message);
  });
}

bool isWholePng(const std::filesystem::path& file, int width, int height) {
  constexpr std::array<std::uint8_t, 12> kEnd = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  std::vector<std::uint8_t> bytes;
  try {
    bytes = readFile(file, kMaxPngBytes);
  } catch (const Error&) {
    return false;
  }
  if (bytes.size() < kEnd.size() || !std::equal(kEnd.rbegin(), kEnd.rend(), bytes.rbegin())) return false;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return false;
  const bool isSize =
      image.width == static_cast<png_uint_32>(width) && image.height == static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb8(isSize ? PNG_IMAGE_SIZE(image) : 0);
  const bool isRead = isSize && png_image_finish_read(&image, nullptr, rgb8.data(), 0, nullptr) != 0;
  png_image_free(&image);
  return isRead && image.warning_or_error == 0;
}

std::vector<std::uint8_t> toneMap(const float* rgb, int width, int height, float exposure, int supersample, Tone tone) {
  return encode(rgb, width, height, supersample,
                [=](const float* pixel) { return toneMapPixel(pixel, exposure, tone); });
}

std::vector<std::uint8_t> encodeColours(const float* rgb, int width, int height, int supersample) {
  return encode(rgb, width, height, supersample,
                [](const float* pixel) { return glm::clamp(glm::vec3(pixel[0], pixel[1], pixel[2]), 0.0F, 1.0F); });
}

} // namespace host
