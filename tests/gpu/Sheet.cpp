#include "Sheet.h"

#include <algorithm>
#include <scene/ImageFile.h>
#include <stb_image.h>

namespace gpu {

namespace {

constexpr int kWidth = 240, kHeight = 135, kGap = 6; // of a picture, pixels
constexpr const char* kKinds[] = {"wanted", "got", "difference"};
constexpr int kPlaceWidth = 3 * kWidth + kGap, kPlaceHeight = kHeight + kGap;

struct Bytes {
  int width, height;
  std::vector<std::uint8_t> rgb;
};

/// Drawn to the size of a picture on the sheet: each pixel is the mean of those that it covers.
bool addPicture(const std::filesystem::path& file, Bytes& sheet, int left, int top) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* const read = stbi_load(file.c_str(), &width, &height, &channels, 3);
  if (!read) return false;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int x0 = x * width / kWidth, x1 = std::max(x0 + 1, (x + 1) * width / kWidth);
      const int y0 = y * height / kHeight, y1 = std::max(y0 + 1, (y + 1) * height / kHeight);
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u)
            sum += read[3 * (v * width + u) + c];
        sheet.rgb[static_cast<std::size_t>(3 * ((top + y) * sheet.width + left + x) + c)] =
            static_cast<std::uint8_t>(sum / ((x1 - x0) * (y1 - y0)));
      }
    }
  stbi_image_free(read);
  return true;
}

} // namespace

SheetPlace placeOnSheet(std::size_t index) {
  const auto i = static_cast<int>(index);
  return {1 + i / kSheetColumns, 1 + i % kSheetColumns};
}

bool writeSheet(const std::filesystem::path& file, const std::filesystem::path& pictures,
                const std::vector<std::string>& cases) {
  if (cases.empty()) return false;
  const SheetPlace last = placeOnSheet(cases.size() - 1);
  Bytes sheet{kSheetColumns * kPlaceWidth, last.row * kPlaceHeight, {}};
  constexpr std::uint8_t kGrey = 64;
  sheet.rgb.assign(static_cast<std::size_t>(3 * sheet.width * sheet.height), kGrey);
  bool hasAny = false;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const SheetPlace place = placeOnSheet(i);
    for (int kind = 0; kind < 3; ++kind)
      hasAny = addPicture(pictures / (cases[i] + "." + kKinds[kind] + ".png"), sheet,
                          (place.column - 1) * kPlaceWidth + kind * kWidth, (place.row - 1) * kPlaceHeight) ||
               hasAny;
  }
  if (hasAny) host::writePng(file, sheet.width, sheet.height, sheet.rgb);
  return hasAny;
}

} // namespace gpu
