// Textures whose files are made to take memory or time.
#include "GltfFile.h"
#include "support/Catch.h"

#include <chrono>
#include <scene/GltfLoader.h>
#include <sys/resource.h>

namespace tests {

namespace {

using Bytes = std::vector<std::uint8_t>;

void append32(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// As a PNG's chunks have it.
std::uint32_t checksumOf(const Bytes& bytes, std::size_t begin) {
  std::uint32_t sum = 0xffffffff;
  for (std::size_t i = begin; i < bytes.size(); ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit)
      sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum;
}

void appendChunk(Bytes& png, const std::string& name, const Bytes& data) {
  append32(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png.insert(png.end(), name.begin(), name.end());
  png.insert(png.end(), data.begin(), data.end());
  append32(png, checksumOf(png, begin));
}

/// Eight bits of grey a pixel.
Bytes pngOf(std::uint32_t width, std::uint32_t height, const Bytes& packed) {
  Bytes header;
  append32(header, width);
  append32(header, height);
  header.insert(header.end(), {8, 0, 0, 0, 0});
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  appendChunk(png, "IHDR", header);
  appendChunk(png, "IDAT", packed);
  appendChunk(png, "IEND", {});
  return png;
}

/// One zero byte and 258 more for each repeat, by deflate's fixed codes.
Bytes packedZeros(int repeats) {
  Bytes packed = {0x78, 0x01};
  unsigned bits = 0, count = 0;
  const auto put = [&](unsigned code, unsigned length) { // its highest bit first
    while (length-- > 0) {
      bits |= (code >> length & 1) << count;
      if (++count < 8) continue;
      packed.push_back(static_cast<std::uint8_t>(bits));
      bits = count = 0;
    }
  };
  put(0b110, 3);      // the last block, of fixed codes
  put(0b00110000, 8); // 0
  for (int i = 0; i < repeats; ++i)
    put(0b1100010100000, 13); // 258 bytes from one byte before
  put(0, 7);                  // the end
  put(0, 8);
  const auto zeros = static_cast<std::uint32_t>(1 + 258 * std::int64_t{repeats});
  append32(packed, zeros % 65521 << 16 | 1); // their Adler-32
  return packed;
}

host::Scene sceneWith(const Bytes& image) {
  GltfFile file = everything();
  file.json["images"][0] = {{"bufferView", file.view(image)}};
  return file.load();
}

long peakMiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

} // namespace

TEST_CASE("a PNG made here is read", "[scene][gltf]") {
  const host::Scene scene = sceneWith(pngOf(258, 1, packedZeros(1)));
  REQUIRE(scene.textures.size() == 1);
  CHECK(scene.textures[0].width == 258);
  CHECK(scene.textures[0].rgba.size() == std::size_t{4} * 258);
  CHECK(scene.textures[0].rgba[3] == 255);
}

TEST_CASE("an image that promises more pixels than it holds is left out", "[scene][gltf]") {
  for (const auto& [side, reason] :
       {std::pair<std::uint32_t, const char*>{16384, "too short"}, {16385, "1 to 16384"}}) {
    const host::Scene scene = sceneWith(pngOf(side, side, packedZeros(1)));
    CHECK(scene.textures.empty());
    CHECK(hasNote(scene, reason));
  }
}

TEST_CASE("a PNG whose chunk claims two gigabytes is left out before they are allocated", "[scene][gltf]") {
  Bytes png = pngOf(258, 1, packedZeros(1));
  constexpr std::size_t kLengthOfData = 8 + 25;
  for (const auto& [place, length] : {std::pair<std::size_t, int>{kLengthOfData, 0x02}, {kLengthOfData, 0x7f}}) {
    png[place] = static_cast<std::uint8_t>(length);
    const host::Scene scene = sceneWith(png);
    CHECK(scene.textures.empty());
    CHECK(hasNote(scene, "cut off in its chunk IDAT"));
  }
}

TEST_CASE("a PNG that unpacks to more than its picture takes no memory for the rest", "[scene][gltf]") {
  constexpr long kMiB = 256;
  const Bytes png = pngOf(258, 1, packedZeros(kMiB * 1024 * 1024 / 258));
  const long before = peakMiB();
  sceneWith(png);
  CHECK(peakMiB() - before < kMiB / 2);
}

TEST_CASE("a PNG's pixels are sRGB, whatever gamma it names", "[scene][gltf]") {
  Bytes header, data = {0x78, 0x01, 0x01, 0x02, 0x00, 0xfd, 0xff, 0x00, 0x80, 0x00, 0x82, 0x00, 0x81}, gamma;
  append32(header, 1);
  append32(header, 1);
  header.insert(header.end(), {8, 0, 0, 0, 0});
  append32(gamma, 100000); // linear
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  appendChunk(png, "IHDR", header);
  appendChunk(png, "gAMA", gamma);
  appendChunk(png, "IDAT", data);
  appendChunk(png, "IEND", {});
  const host::Scene scene = sceneWith(png);
  REQUIRE(scene.textures.size() == 1);
  CHECK(scene.textures[0].rgba == Bytes{0x80, 0x80, 0x80, 255});
}

TEST_CASE("a JPEG of nothing but scans is left out at once", "[scene][gltf]") {
  Bytes jpeg = {0xFF, 0xD8, 0xFF, 0xC2, 0, 11, 8, 0x20, 0, 0x20, 0, 1, 1, 0x11, 0}; // progressive, 8192 x 8192, grey
  for (int scan = 0; scan < 30000; ++scan)
    jpeg.insert(jpeg.end(), {0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 0, 0x10});
  const auto begin = std::chrono::steady_clock::now();
  const host::Scene scene = sceneWith(jpeg);
  CHECK(scene.textures.empty());
  CHECK(hasNote(scene, "more than 100 scans"));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
}

} // namespace tests
