// EXR files. What is read can be written and read back, to the last bit but for which NaN it is.
#include "Fuzz.h"

#include <cmath>
#include <scene/Error.h>
#include <scene/ImageFile.h>

namespace {

bool same(const host::Image& a, const host::Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const host::Channel &x = a.channels[c], &y = b.channels[c];
    if (x.name != y.name || x.values.size() != y.values.size()) return false;
    for (std::size_t i = 0; i < x.values.size(); ++i)
      if (x.values[i] != y.values[i] && !(std::isnan(x.values[i]) && std::isnan(y.values[i]))) return false;
  }
  return true;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::fileOf("input.exr", data, size);
  host::Image image;
  if (!fuzz::accepts<host::Error>([&] { image = host::readExr(file); })) return 0;
  for (const host::Channel& channel : image.channels)
    fuzz::require(channel.values.size() == static_cast<std::size_t>(image.width) * image.height, "channels are whole");
  const std::filesystem::path copy = fuzz::folder() / "copy.exr";
  if (fuzz::accepts<host::Error>([&] { host::writeExr(copy, image); }))
    fuzz::require(same(host::readExr(copy), image), "an EXR is read back");
  return 0;
}
