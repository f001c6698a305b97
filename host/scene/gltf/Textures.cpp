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
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::ClampToEdge;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat : Wrap::Repeat;
}

} // namespace

int TextureLoader::load(int index) {
  const auto found = loaded_.find(index);
  if (found != loaded_.end()) return found->second;
  const tinygltf::Texture& source = document_.model.textures[static_cast<std::size_t>(index)];
  int result = -1;
  try {
    if (source.source < 0) throw Error("names no image that can be read");
    Texture texture;
    decode(encodedImage(static_cast<std::size_t>(source.source)), texture);
    setWrap(source.sampler, texture);
    textures_.push_back(std::move(texture));
    result = static_cast<int>(textures_.size()) - 1;
  } catch (const Error& error) {
    document_.note(at("textures", static_cast<std::size_t>(index)), std::string("is left out: ") + error.what());
  }
  loaded_[index] = result;
  return result;
}

std::vector<std::uint8_t> TextureLoader::encodedImage(std::size_t index) {
  const nlohmann::json& image = document_.json["images"][index];
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
  if (view >= document_.model.bufferViews.size()) throw Error(name + ".bufferView: there is no such buffer view");
  const tinygltf::BufferView& bufferView = document_.model.bufferViews[view];
  const Bytes& buffer = document_.buffers[static_cast<std::size_t>(bufferView.buffer)];
  if (buffer.data == nullptr) throw Error(name + ".bufferView: its buffer has no data");
  const std::uint8_t* begin = buffer.data + bufferView.byteOffset;
  return {begin, begin + bufferView.byteLength};
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

void TextureLoader::setWrap(int sampler, Texture& texture) {
  if (sampler < 0) return;
  const tinygltf::Sampler& source = document_.model.samplers[static_cast<std::size_t>(sampler)];
  texture.wrapU = wrapOf(source.wrapS);
  texture.wrapV = wrapOf(source.wrapT);
}

} // namespace host::gltf
