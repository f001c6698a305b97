#include "Compare.h"

#include "Flip.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <render/Outputs.h>
#include <scene/ImageFile.h>

namespace regress {

namespace {

bool isSame(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// What differences are relative to: the mean of the finite values, or 1 for a black picture.
double scaleOf(const HdrPicture& picture) {
  double sum = 0;
  std::size_t count = 0;
  for (const float value : picture.rgb)
    if (std::isfinite(value)) {
      sum += std::abs(value);
      ++count;
    }
  return sum > 0 ? sum / static_cast<double>(count) : 1;
}

/// The value that `share` of all are not above.
double percentileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  const auto nth = values.begin() + std::max<std::ptrdiff_t>(rank, 0);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

double luminance(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

/// From grey to red or blue; `amount` from -1 to 1.
glm::vec3 divergingColour(double amount) {
  const glm::vec3 grey(0.16F), end = amount > 0 ? glm::vec3(1.0F, 0.13F, 0.03F) : glm::vec3(0.03F, 0.25F, 1.0F);
  return glm::mix(grey, end, static_cast<float>(std::sqrt(std::min(std::abs(amount), 1.0))));
}

} // namespace

Difference compare(const HdrPicture& wanted, const HdrPicture& got, double pixelTolerance,
                   const render::Options& options, float exposure) {
  Difference difference;
  const double scale = scaleOf(wanted);
  std::vector<double> pixels;
  double squares = 0;
  std::size_t over = 0;
  for (std::size_t i = 0; i < wanted.rgb.size(); i += 3) {
    double largest = 0;
    bool isOdd = false;
    for (std::size_t c = i; c < i + 3; ++c) {
      if (isSame(wanted.rgb[c], got.rgb[c])) continue;
      const double relative = (static_cast<double>(got.rgb[c]) - wanted.rgb[c]) / scale;
      isOdd = isOdd || !std::isfinite(relative);
      squares += std::isfinite(relative) ? relative * relative : 0;
      largest = std::max(largest, std::abs(relative));
    }
    if (isOdd) {
      ++difference.notFinite;
      continue;
    }
    pixels.push_back(largest);
    over += largest > pixelTolerance ? 1 : 0;
    difference.max = std::max(difference.max, largest);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(pixels.size(), 1));
  difference.rRmse = std::sqrt(squares / (3 * count));
  difference.over = static_cast<double>(over) / count;
  difference.p99 = percentileOf(std::move(pixels), 0.99);
  difference.flip = meanOf(flip(render::displayed(wanted.rgb, options, exposure),
                                render::displayed(got.rgb, options, exposure), options.width, options.height));
  return difference;
}

std::vector<Judgement> judge(const Difference& difference, const Tolerance& tolerance) {
  std::vector<Judgement> judgements = {
      {"rRMSE", difference.rRmse, tolerance.rRmse, true},
      {"p99", difference.p99, tolerance.p99, true},
      {"max", difference.max, tolerance.max, true},
      {"pixels over " + textOf(tolerance.pixel, true), difference.over, tolerance.over, true}};
  if (tolerance.flip) judgements.push_back({"FLIP", difference.flip, *tolerance.flip, false});
  if (difference.notFinite > 0)
    judgements.push_back({"pixels not finite in only one", static_cast<double>(difference.notFinite), 0, false});
  return judgements;
}

std::string textOf(double value, bool isRelative) {
  const double shown = isRelative ? 100 * value : value;
  if (!std::isfinite(shown)) return "infinite";
  return fmt::format(shown >= 1000 ? "{:.0f}{}" : "{:.3g}{}", shown, isRelative ? " %" : "");
}

std::vector<std::uint8_t> differenceColours(const HdrPicture& wanted, const HdrPicture& got, double range) {
  const double full = range * scaleOf(wanted);
  std::vector<float> colours;
  colours.reserve(wanted.rgb.size());
  for (std::size_t i = 0; i < wanted.rgb.size(); i += 3) {
    const double amount = (luminance(&got.rgb[i]) - luminance(&wanted.rgb[i])) / full;
    const bool isEqual = isSame(wanted.rgb[i], got.rgb[i]) && isSame(wanted.rgb[i + 1], got.rgb[i + 1]) &&
                         isSame(wanted.rgb[i + 2], got.rgb[i + 2]);
    // A NaN in one of them is magenta, as in pictures.
    const glm::vec3 colour = isEqual              ? divergingColour(0)
                             : std::isnan(amount) ? glm::vec3(1, 0, 1)
                                                  : divergingColour(amount);
    colours.insert(colours.end(), {colour.r, colour.g, colour.b});
  }
  return host::encodeColours(colours.data(), wanted.width, wanted.height);
}

} // namespace regress
