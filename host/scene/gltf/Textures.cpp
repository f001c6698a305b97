#include "Textures.h"

#include "Buffers.h"

#include <cstring>
#include <memory>
#include <png.h>
#include <scene/Error.h>
#include <stb_image.h>

namespace host::gltf {

namespace {

/// The most pixels that a byte can stand for: in a PNG 1032 : 1 by deflate, 8 to a byte; in a JPEG 2 bits for 8 x 8. An
/// image that promises more is broken, and would only cost time and memory.
constexpr std::uint64_t kMaxPngPixelsPerByte = 8 * 1032, kMaxJpegPixelsPerByte = 256;

/// Of a JPEG. Each goes over all of the picture: progressive ones have ten, and a file of nothing else thousands.
constexpr int kMaxScans = 100;

constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::uint8_t kJpeg[] = {0xFF, 0xD8, 0xFF};

template <std::size_t size>
bool beginsWith(const std::vector<std::uint8_t>& bytes, const std::uint8_t (&magic)[size]) {
  return bytes.size() >= size && std::memcmp(bytes.data(), magic, size) == 0;
}

/// A PNG without the chunks that only say how its colours are meant: glTF has them be sRGB, whatever these say.
std::vector<std::uint8_t> essentialChunks(const std::vector<std::uint8_t>& png) {
  constexpr std::size_t kAround = 12; // of a chunk's data: length, name, checksum
  std::vector<std::uint8_t> kept(png.begin(), png.begin() + sizeof kPng);
  for (std::size_t at = sizeof kPng; at + kAround <= png.size();) {
    const std::uint8_t* chunk = &png[at];
    const std::size_t length =
        std::size_t{chunk[0]} << 24 | std::size_t{chunk[1]} << 16 | std::size_t{chunk[2]} << 8 | std::size_t{chunk[3]};
    const std::string_view name(reinterpret_cast<const char*>(chunk) + 4, 4);
    if (length > png.size() - at - kAround) throw Error("the image is cut off in its chunk " + printable(name));
    const bool isCritical = name[0] >= 'A' && name[0] <= 'Z';
    if (isCritical || name == "tRNS") kept.insert(kept.end(), chunk, chunk + kAround + length);
    at += kAround + length;
  }
  return kept;
}

int scansOf(const std::vector<std::uint8_t>& jpeg) {
  int scans = 0;
  for (std::size_t i = 1; i < jpeg.size(); ++i)
    scans += jpeg[i - 1] == 0xFF && jpeg[i] == 0xDA ? 1 : 0;
  return scans;
}

Wrap wrapOf(int mode) {
  constexpr int kClampToEdge = 33071, kMirroredRepeat = 33648; // GL's
  if (mode == kClampToEdge) return Wrap::ClampToEdge;
  return mode == kMirroredRepeat ? Wrap::MirroredRepeat : Wrap::Repeat;
}

} // namespace

int TextureLoader::load(int index) {
  const auto found = loaded_.find(index);
  if (found != loaded_.end()) return found->second;
  const nlohmann::json& source = document_.element("textures", index);
  int result = -1;
  try {
    if (!source.contains("source")) throw Error("names no image that can be read");
    Texture texture;
    decode(encodedImage(source["source"].get<std::size_t>()), texture);
    if (source.contains("sampler")) {
      const nlohmann::json& sampler = document_.element("samplers", source["sampler"].get<std::size_t>());
      texture.wrapU = wrapOf(sampler.value("wrapS", 0));
      texture.wrapV = wrapOf(sampler.value("wrapT", 0));
    }
    textures_.push_back(std::move(texture));
    result = static_cast<int>(textures_.size()) - 1;
  } catch (const Error& error) {
    document_.note(at("textures", static_cast<std::size_t>(index)), std::string("is left out: ") + error.what());
  }
  loaded_[index] = result;
  return result;
}

std::vector<std::uint8_t> TextureLoader::encodedImage(std::size_t index) {
  const nlohmann::json& image = document_.element("images", index);
  const std::string name = at("images", index);
  if (image.contains("uri")) {
    try {
      return loadUri(document_, image["uri"].get_ref<const std::string&>());
    } catch (const Error& error) {
      throw Error(name + ".uri: " + error.what());
    }
  }
  if (!image.contains("bufferView")) throw Error(name + ": has neither uri nor bufferView");
  const auto view = image["bufferView"].get<std::size_t>();
  if (view >= document_.count("bufferViews")) throw Error(name + ".bufferView: there is no such buffer view");
  const nlohmann::json& bufferView = document_.element("bufferViews", view);
  const Bytes& buffer = document_.buffers[bufferView["buffer"].get<std::size_t>()];
  if (buffer.data == nullptr) throw Error(name + ".bufferView: its buffer has no data");
  const std::uint8_t* begin = buffer.data + bufferView.value("byteOffset", std::size_t{0});
  return {begin, begin + bufferView["byteLength"].get<std::size_t>()};
}

void TextureLoader::decode(const std::vector<std::uint8_t>& encoded, Texture& texture) {
  if (beginsWith(encoded, kPng))
    decodePng(encoded, texture);
  else if (beginsWith(encoded, kJpeg))
    decodeJpeg(encoded, texture);
  else
    throw Error("the image is neither PNG nor JPEG");
}

/// Before anything is decoded.
void TextureLoader::makeRoom(Texture& texture, std::uint64_t most) {
  if (texture.width < 1 || texture.height < 1 || texture.width > kMaxTextureSize || texture.height > kMaxTextureSize) {
    throw Error("the image's sides must be 1 to " + std::to_string(kMaxTextureSize) + " pixels");
  }
  const std::uint64_t pixels = static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height);
  if (pixels > most) throw Error("the image is too short for its size in pixels");
  document_.spend(4 * pixels, "textures");
  texture.rgba.resize(4 * pixels);
}

/// By libpng, row by row: what the data would unpack to beyond the picture is not unpacked.
void TextureLoader::decodePng(const std::vector<std::uint8_t>& encoded, Texture& texture) {
  const std::vector<std::uint8_t> chunks = essentialChunks(encoded);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&image, png_image_free);
  const auto require = [&image](int success, const char* what) {
    if (success == 0) throw Error(std::string("the image cannot be ") + what + ": " + printable(image.message));
  };
  require(png_image_begin_read_from_memory(&image, chunks.data(), chunks.size()), "read");
  texture.width = static_cast<int>(image.width);
  texture.height = static_cast<int>(image.height);
  makeRoom(texture, kMaxPngPixelsPerByte * encoded.size());
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  require(png_image_finish_read(&image, nullptr, texture.rgba.data(), 0, nullptr), "decoded");
}

void TextureLoader::decodeJpeg(const std::vector<std::uint8_t>& encoded, Texture& texture) {
  const int size = static_cast<int>(encoded.size());
  int channels = 0;
  if (stbi_info_from_memory(encoded.data(), size, &texture.width, &texture.height, &channels) == 0) {
    throw Error(std::string("the image cannot be read: ") + stbi_failure_reason());
  }
  if (scansOf(encoded) > kMaxScans) throw Error("the image has more than " + std::to_string(kMaxScans) + " scans");
  makeRoom(texture, kMaxJpegPixelsPerByte * encoded.size());
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(encoded.data(), size, &texture.width, &texture.height, &channels, 4), stbi_image_free);
  if (rgba == nullptr) throw Error(std::string("the image cannot be decoded: ") + stbi_failure_reason());
  std::memcpy(texture.rgba.data(), rgba.get(), texture.rgba.size());
}

} // namespace host::gltf
