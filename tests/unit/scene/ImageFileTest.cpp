#include "GltfFile.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numeric>
#include <scene/Error.h>
#include <scene/ImageFile.h>

namespace tests {

namespace {

std::size_t fileCount(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()));
}

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const host::Error& error) {
    return error.what();
  }
  FAIL("not refused");
  return {};
}

host::Image sample() {
  host::Image image;
  image.width = 3;
  image.height = 2;
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  constexpr float kHuge = std::numeric_limits<float>::max();
  image.channels = {{"R", {0, 1, -2, 0.1F, kTiny, kHuge}},
                    {"inscatter.G", {1, 2, 3, 4, 5, 6}},
                    {"Z", {INFINITY, -INFINITY, NAN, -0.0F, 1e-30F, 16777217.0F}}};
  return image;
}

std::vector<std::uint8_t> tone(const std::vector<float>& rgb, float exposure = 1) {
  return host::toneMap(rgb.data(), static_cast<int>(rgb.size() / 3), 1, exposure);
}

} // namespace

TEST_CASE("An EXR gives back every bit", "[scene][image]") {
  const TemporaryFolder folder;
  const host::Image image = sample();
  host::writeExr(folder / "a.exr", image);
  const host::Image read = host::readExr(folder / "a.exr");
  CHECK(read.width == 3);
  CHECK(read.height == 2);
  REQUIRE(read.channels.size() == 3);
  for (const host::Channel& channel : image.channels) {
    const std::vector<float>* values = read.find(channel.name);
    REQUIRE(values != nullptr);
    REQUIRE(values->size() == channel.values.size());
    CHECK(std::memcmp(values->data(), channel.values.data(), values->size() * sizeof(float)) == 0);
  }
  CHECK(read.find("G") == nullptr);
  CHECK(fileCount(folder) == 1);
}

TEST_CASE("Channels are taken from interleaved pixels, bottom row first if so", "[scene][image]") {
  host::Image image;
  image.width = 2;
  image.height = 2;
  const float pixels[] = {0, 10, 1, 11, 2, 12, 3, 13};
  image.addChannel("up", pixels, 2, 0, true);
  image.addChannel("down", pixels, 2, 1, false);
  CHECK(*image.find("up") == std::vector<float>{2, 3, 0, 1});
  CHECK(*image.find("down") == std::vector<float>{10, 11, 12, 13});
}

TEST_CASE("A supersampled picture is the mean of what a display would show", "[scene][image]") {
  // 2 x 1 pixels of 2 x 2 each: half of the first is far brighter than white, the second is black.
  std::vector<float> rgb(2 * 2 * 2 * 3, 0.0F);
  for (const int pixel : {0, 5})
    for (int c = 0; c < 3; ++c)
      rgb[static_cast<std::size_t>(3 * pixel + c)] = 1e4F;
  const std::vector<std::uint8_t> bytes = host::toneMap(rgb.data(), 2, 1, 1, 2);
  CHECK(bytes == std::vector<std::uint8_t>{188, 188, 188, 0, 0, 0}); // sRGB of half the display's light
}

TEST_CASE("Images that are malformed are not written", "[scene][image]") {
  const TemporaryFolder folder;
  const auto message = [&](const host::Image& image) {
    return refusal([&] { host::writeExr(folder / "a.exr", image); });
  };
  using Catch::Contains;
  host::Image image = sample();
  image.width = 0;
  CHECK_THAT(message(image), Contains("a.exr: the image is 0 x 2"));
  image.width = 16385;
  CHECK_THAT(message(image), Contains("1 to 16384"));
  image = sample();
  image.channels[1].values.pop_back();
  CHECK_THAT(message(image), Contains("channel \"inscatter.G\" must have a value for each pixel"));
  image = sample();
  image.channels[1].name = "R";
  CHECK_THAT(message(image), Contains("must have a name of its own"));
  image.channels.clear();
  CHECK_THAT(message(image), Contains("no channels"));
  CHECK_THAT(refusal([&] { host::writePng(folder / "a.png", 2, 2, {1, 2, 3}); }), Contains("three bytes"));
  CHECK(fileCount(folder) == 0);
}

TEST_CASE("What cannot be written leaves no file, and an old one as it was", "[scene][image]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken.exr");
  CHECK_THAT(refusal([&] { host::writeExr(folder / "taken.exr", sample()); }),
             Contains("taken.exr: cannot be written"));
  CHECK_THAT(refusal([&] { host::writeExr(folder / "none/a.exr", sample()); }), Contains("folder does not exist"));
  CHECK_THAT(refusal([&] { host::writePng(folder / "none/a.png", 1, 1, {1, 2, 3}); }),
             Contains("folder does not exist"));
  CHECK_THAT(refusal([] { host::writeExr("/proc/a.exr", sample()); }), Contains("/proc/a.exr: cannot be written"));
  CHECK_THAT(refusal([] { host::writePng("/proc/a.png", 1, 1, {1, 2, 3}); }),
             Contains("/proc/a.png: cannot be written"));
  CHECK_THAT(refusal([] { host::writePng("", 1, 1, {1, 2, 3}); }), Contains("cannot be written"));
  CHECK(fileCount(folder) == 1);
  host::writeExr(folder / "a.exr", sample());
  const std::vector<std::uint8_t> before = readBytes(folder / "a.exr");
  host::Image broken = sample();
  broken.channels[0].values.clear();
  refusal([&] { host::writeExr(folder / "a.exr", broken); });
  CHECK(readBytes(folder / "a.exr") == before);
  CHECK(fileCount(folder) == 2);
}

TEST_CASE("A file that is no EXR is refused by name", "[scene][image]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  CHECK_THAT(refusal([&] { host::readExr(folder / "none.exr"); }), Contains("none.exr: cannot be read"));
  writeBytes(folder / "text.exr", {'h', 'e', 'l', 'l', 'o'});
  CHECK_THAT(refusal([&] { host::readExr(folder / "text.exr"); }), Contains("text.exr: cannot be read"));
  host::writeExr(folder / "a.exr", sample());
  const std::vector<std::uint8_t> whole = readBytes(folder / "a.exr");
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    writeBytes(folder / "cut.exr", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    CHECK_THROWS_AS(host::readExr(folder / "cut.exr"), host::Error);
  }
}

TEST_CASE("An EXR's header is judged before memory is taken by it", "[scene][image]") {
  using Catch::Contains;
  const TemporaryFolder folder;
  host::writeExr(folder / "a.exr", sample());
  const std::vector<std::uint8_t> whole = readBytes(folder / "a.exr");
  const std::string name = "dataWindow";
  const auto at = std::search(whole.begin(), whole.end(), name.begin(), name.end());
  REQUIRE(at != whole.end());
  const std::ptrdiff_t corner = at - whole.begin() + 11 + 6 + 4 + 8; // name, "box2i", its size, the other corner
  struct Corner {
    std::int32_t x, y;
  };
  // OpenEXR alone would take 64 GiB for lines of the last.
  for (const Corner claimed : {Corner{16384, 1}, {1 << 23, 1}, {1 << 29, 1}}) {
    std::vector<std::uint8_t> bytes = whole;
    std::memcpy(bytes.data() + corner, &claimed, sizeof(claimed));
    writeBytes(folder / "huge.exr", bytes);
    INFO(claimed.x << " x " << claimed.y);
    CHECK_THAT(refusal([&] { host::readExr(folder / "huge.exr"); }), Contains("its sides must be 1 to 16384"));
  }
}

TEST_CASE("An EXR of more lines than are read at a time gives back every bit", "[scene][image]") {
  const TemporaryFolder folder;
  host::Image image;
  image.width = 5;
  image.height = 600;
  for (const char* name : {"A", "B"}) {
    std::vector<float> values(3000);
    std::iota(values.begin(), values.end(), name[0]);
    image.channels.push_back({name, values});
  }
  host::writeExr(folder / "a.exr", image);
  const host::Image read = host::readExr(folder / "a.exr");
  REQUIRE(read.channels.size() == 2);
  CHECK(read.channels[0].values == image.channels[0].values);
  CHECK(read.channels[1].values == image.channels[1].values);
}

TEST_CASE("A PNG holds the bytes, top row first", "[scene][image]") {
  const std::vector<std::uint8_t> rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3};
  GltfFile file = everything();
  const TemporaryFolder folder;
  host::writePng(folder / "a.png", 2, 2, rgb);
  file.json["images"][0] = {{"bufferView", file.view(readBytes(folder / "a.png"))}};
  const std::vector<std::uint8_t> rgba = file.load().textures.at(0).rgba;
  CHECK(rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 1, 2, 3, 255});
  CHECK(fileCount(folder) == 1);
}

TEST_CASE("Tone mapping keeps black, order and hue, and fades to white", "[scene][image]") {
  CHECK(tone({0, 0, 0}) == std::vector<std::uint8_t>{0, 0, 0});
  CHECK(tone({-1, -2, -3}) == std::vector<std::uint8_t>{0, 0, 0});
  CHECK(tone({1e9F, 1e9F, 1e9F}) == std::vector<std::uint8_t>{255, 255, 255});
  CHECK(tone({INFINITY, 0, 0}) == std::vector<std::uint8_t>{255, 255, 255});
  CHECK(tone({NAN, 0, 0, 0, 0, 0}) == std::vector<std::uint8_t>{255, 0, 255, 0, 0, 0});
  // 0.18 through the curve is 0.2669, of which the sRGB encoding is 0.5538: 141 of 255.
  CHECK(tone({0.18F, 0.18F, 0.18F}) == std::vector<std::uint8_t>{141, 141, 141});
  CHECK(tone({0.09F, 0.09F, 0.09F}, 2) == tone({0.18F, 0.18F, 0.18F}));
  int before = -1;
  for (float x = 1e-4F; x < 100; x *= 1.1F) {
    const std::vector<std::uint8_t> grey = tone({x, x, x});
    CHECK(grey[0] >= before);
    CHECK((grey[0] == grey[1] && grey[1] == grey[2]));
    before = grey[0];
    const std::vector<std::uint8_t> orange = tone({x, x / 2, 0});
    CHECK((orange[0] >= orange[1] && orange[1] >= orange[2]));
  }
}

} // namespace tests
