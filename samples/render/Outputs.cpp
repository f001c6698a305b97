#include "Outputs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/ImageFile.h>
#include <settings/Tables.h>

namespace render {

namespace {

bool isPng(const std::filesystem::path& file) {
  return std::tolower(static_cast<unsigned char>(file.extension().string().at(1))) == 'p';
}

/// Radiance takes the film curve; the colours of the other views mean numbers.
bool isRadiance(const Options& options) {
  const tyndall::DebugView view = options.settings.debugView;
  return view == tyndall::DebugView::Composite || view == tyndall::DebugView::Inscatter;
}

host::Image imageOf(const Picture& picture, int width, int height) {
  host::Image image;
  image.width = width;
  image.height = height;
  const char* const letters[] = {"R", "G", "B"};
  for (int channel = 0; channel < 3; ++channel) {
    const std::string letter = letters[channel];
    image.addChannel(letter, picture.composite.data(), 4, channel, true);
    image.addChannel("inscatter." + letter, picture.inscatter.data(), 4, channel, true);
    image.addChannel("transmittance." + letter, picture.transmittance.data(), 4, channel, true);
  }
  image.addChannel("Z", picture.z.data(), 1, 0, true);
  return image;
}

nlohmann::ordered_json passesOf(const std::vector<tyndall::PassStatistics>& statistics) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const tyndall::PassStatistics& pass : statistics) {
    if (pass.skipped.empty())
      passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
    else
      passes.push_back({{"name", pass.name}, {"skipped", pass.skipped}});
    if (pass.bands > 1) passes.back().update({{"bands", pass.bands}, {"longest_ms", pass.longestBand}});
  }
  return passes;
}

/// "avsm": what smoke, fog and strands cost, for each light and the eye.
nlohmann::ordered_json volumeShadowsOf(const std::vector<VolumeShadowStatistics>& maps) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const VolumeShadowStatistics& map : maps) {
    nlohmann::ordered_json json;
    if (map.light == VolumeShadowStatistics::kEye)
      json["eye"] = true;
    else
      json["light"] = map.light;
    json.update({{"segments", map.avsm.segments},
                 {"lost", map.avsm.lost},
                 {"list_bytes", map.avsm.listBytes},
                 {"curve_bytes", map.avsm.curveBytes},
                 {"capture_ms", map.captureMilliseconds},
                 {"passes", passesOf(map.avsm.passes)}});
    list.push_back(std::move(json));
  }
  return list;
}

nlohmann::ordered_json statisticsOf(const FrameStatistics& frame, const Options& options,
                                    const host::Context& context) {
  const Measurement& measurement = frame.measurement;
  nlohmann::ordered_json json = {{"driver", context.driver()},
                                 {"context", host::nameOf(context.kind())},
                                 {"size", {renderedWidth(options), renderedHeight(options)}},
                                 {"technique", settings::nameOf(options.settings.technique)},
                                 {"profile", settings::nameOf(options.profile)},
                                 {"effect_ms",
                                  {{"median", measurement.median()},
                                   {"min", measurement.milliseconds.front()},
                                   {"max", measurement.milliseconds.back()}}},
                                 {"bytes", measurement.statistics.bytes},
                                 {"passes", passesOf(measurement.statistics.passes)},
                                 {"marched_samples", measurement.statistics.marchedSamples},
                                 {"fixup_pixels", measurement.statistics.fixupPixels},
                                 {"drawn_slices", measurement.statistics.drawnSlices},
                                 {"error_estimate", measurement.statistics.errorEstimate},
                                 {"share_over_target", measurement.statistics.shareOverTarget},
                                 {"redrawn_share", measurement.statistics.redrawnShare}};
  if (!measurement.volumeShadows.empty()) json["avsm"] = volumeShadowsOf(measurement.volumeShadows);
  return json;
}

} // namespace

std::vector<float> topDownRgb(const std::vector<float>& bottomUpRgba, int width, int height) {
  std::vector<float> rgb;
  rgb.reserve(bottomUpRgba.size() / 4 * 3);
  for (int row = height - 1; row >= 0; --row)
    for (int column = 0; column < width; ++column) {
      const float* pixel = bottomUpRgba.data() + 4 * (static_cast<std::size_t>(row) * width + column);
      rgb.insert(rgb.end(), pixel, pixel + 3);
    }
  return rgb;
}

std::filesystem::path nameOfFrame(const std::filesystem::path& pattern, int frame) {
  std::string name = pattern.string();
  const std::string place = "%04d";
  for (std::size_t at = name.find(place); at != std::string::npos; at = name.find(place))
    name.replace(at, place.size(), fmt::format("{:04d}", frame));
  return name;
}

float exposureOf(const Picture& picture) {
  constexpr double kMiddleGrey = 0.18;
  constexpr double kHighlight = 1.5; // the film curve still has some contrast left there
  std::vector<double> luminances;
  double sum = 0;
  for (std::size_t i = 0; i + 3 < picture.composite.size(); i += 4) {
    const float* c = picture.composite.data() + i;
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    if (!(luminance > 0) || !std::isfinite(luminance)) continue;
    luminances.push_back(luminance);
    sum += std::log(luminance);
  }
  if (luminances.empty()) return 1;
  const auto bright = luminances.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(luminances.size()));
  std::nth_element(luminances.begin(), bright, luminances.end());
  const double mean = std::exp(sum / static_cast<double>(luminances.size()));
  return static_cast<float>(std::clamp(std::min(kMiddleGrey / mean, kHighlight / *bright), 1e-30, 1e30));
}

bool needsExposure(const Options& options) {
  return isRadiance(options) && std::any_of(options.out.begin(), options.out.end(), isPng);
}

std::vector<std::uint8_t> displayed(const std::vector<float>& rgb, const Options& options, float exposure) {
  return isRadiance(options)
             ? host::toneMap(rgb.data(), options.width, options.height, exposure, options.supersample, options.tone)
             : host::encodeColours(rgb.data(), options.width, options.height, options.supersample);
}

void requirePictureName(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension != ".exr" && extension != ".png")
    throw host::Error(host::printable(file.string()) + ": must end in .exr or .png");
}

void writePicture(const std::filesystem::path& file, const Picture& picture, const Options& options, float exposure) {
  if (!isPng(file)) {
    host::writeExr(file, imageOf(picture, renderedWidth(options), renderedHeight(options)));
    return;
  }
  const std::vector<float> rgb = topDownRgb(picture.composite, renderedWidth(options), renderedHeight(options));
  host::writePng(file, options.width, options.height, displayed(rgb, options, exposure));
}

bool isWholePicture(const std::filesystem::path& file, const Options& options) {
  if (isPng(file)) return host::isWholePng(file, options.width, options.height);
  try {
    const host::Image image = host::readExr(file);
    const std::vector<host::Channel> wanted = imageOf({}, 0, 0).channels;
    return image.width == renderedWidth(options) && image.height == renderedHeight(options) &&
           image.channels.size() == wanted.size() &&
           std::all_of(wanted.begin(), wanted.end(),
                       [&](const host::Channel& channel) { return image.find(channel.name) != nullptr; });
  } catch (const host::Error&) {
    return false;
  }
}

void writeStatistics(const std::filesystem::path& file, const Options& options, const host::Context& context,
                     const std::vector<FrameStatistics>& frames) {
  nlohmann::ordered_json json;
  if (options.frames)
    for (const FrameStatistics& frame : frames)
      json["frames"].push_back(statisticsOf(frame, options, context));
  else
    json = statisticsOf(frames.front(), options, context);
  // A driver's name may hold any bytes: those that are not UTF-8 are replaced instead of thrown over.
  host::writeText(file, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

} // namespace render
