// PNG and JPEG files: as the base-colour texture of a scene, and as a picture of which tyndall-render --resume has to
// know whether it is whole.
#include "Fuzz.h"

#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/ImageFile.h>
#include <scene/gltf/Textures.h>

namespace {

/// The 32-bit number that begins there, its highest byte first.
int sideAt(const std::uint8_t* data, std::size_t size, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = place; i < place + 4; ++i)
    number = number << 8 | (i < size ? data[i] : 0U);
  return static_cast<int>(number & 0x7fffU);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::fileOf("input.png", data, size);
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20; // in a PNG
  host::isWholePng(file, sideAt(data, size, kWidthAt), sideAt(data, size, kHeightAt));

  host::gltf::Document document(fuzz::folder() / "input.gltf");
  document.json = {{"textures", {{{"source", 0}}}}, {"images", {{{"uri", "input.png"}}}}};
  std::vector<host::Texture> textures;
  fuzz::accepts<host::Error>([&] {
    if (host::gltf::TextureLoader(document, textures).load(0) < 0) return;
    const host::Texture& texture = textures.at(0);
    const auto texels = static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    fuzz::require(texels > 0 && texture.rgba.size() == 4 * texels, "a texture is whole");
  });
  return 0;
}
