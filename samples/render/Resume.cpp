#include "Resume.h"
#include "Outputs.h"

#include <algorithm>
#include <fmt/format.h>

namespace render {

std::vector<int> missingFrames(const Options& options) {
  std::vector<int> frames = framesOf(options);
  const auto isThere = [&](int frame) {
    return std::all_of(options.out.begin(), options.out.end(), [&](const std::filesystem::path& file) {
      return isWholePicture(nameOfFrame(file, frame), options);
    });
  };
  frames.erase(std::remove_if(frames.begin(), frames.end(), isThere), frames.end());
  return frames;
}

std::string rangesOf(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < frames.size(); first = ++last) {
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1)
      ++last;
    text += text.empty() ? "" : ",";
    text += first == last ? fmt::format("{}", frames[first]) : fmt::format("{}-{}", frames[first], frames[last]);
  }
  return text;
}

} // namespace render
