#include "Textures.h"

#include "Buffers.h"

#include <cstring>
#include <memory>
#include <scene/Error.h>
#include <stb_image.h>

namespace host::gltf {

namespace {

/// The most pixels that a byte of a PNG can stand for (1032 : 1 by deflate, 8 to a byte); JPEGs hold far less. An image
/// that promises more is broken, and would only cost time and memory.
constexpr std::uint64_t kMaxPixelsPerByte = 8 * 1032;

bool isPngOrJpeg(const std::vector<std::uint8_t>& bytes) {
  constexpr std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::uint8_t kJpeg[] = {0xFF, 0xD8, 0xFF};
  const auto beginsWith = [&](const auto& magic) {
    return bytes.size() >= sizeof magic && std::memcmp(bytes.data(), magic, sizeof magic) == 0;
  };
  return beginsWith(kPng) || beginsWith(kJpeg);
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
  if (!isPngOrJpeg(encoded)) throw Error("the image is neither PNG nor JPEG");
  const int size = static_cast<int>(encoded.size());
  int channels = 0;
  if (stbi_info_from_memory(encoded.data(), size, &texture.width, &texture.height, &channels) == 0) {
    throw Error(std::string("the image cannot be read: ") + stbi_failure_reason());
  }
  if (texture.width < 1 || texture.height < 1 || texture.width > kMaxTextureSize || texture.height > kMaxTextureSize) {
    throw Error("the image's sides must be 1 to " + std::to_string(kMaxTextureSize) + " pixels");
  }
  const std::uint64_t pixels = static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height);
  if (pixels > kMaxPixelsPerByte * encoded.size()) throw Error("the image is too short for its size in pixels");
  document_.spend(4 * pixels, "textures");
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(encoded.data(), size, &texture.width, &texture.height, &channels, 4), stbi_image_free);
  if (rgba == nullptr) throw Error(std::string("the image cannot be decoded: ") + stbi_failure_reason());
  texture.rgba.assign(rgba.get(), rgba.get() + 4 * pixels);
}

} // namespace host::gltf
