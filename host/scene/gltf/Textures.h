// Base-colour textures: images found, bounded and decoded.
#pragma once

#include "Document.h"

#include <map>
#include <scene/Scene.h>

namespace host::gltf {

class TextureLoader {
public:
  TextureLoader(Document& document, std::vector<Texture>& textures) : document_(document), textures_(textures) {}

  /// The index in `textures` of one of the file's textures, decoded when first asked for; -1, with a note, if it
  /// cannot.
  int load(int texture);

private:
  std::vector<std::uint8_t> encodedImage(std::size_t image);
  void decode(const std::vector<std::uint8_t>& encoded, Texture& texture);
  void decodePng(const std::vector<std::uint8_t>& encoded, Texture& texture);
  void decodeJpeg(const std::vector<std::uint8_t>& encoded, Texture& texture);
  void makeRoom(Texture& texture, std::uint64_t most);

  Document& document_;
  std::vector<Texture>& textures_;
  std::map<int, int> loaded_; // the file's texture to ours
};

} // namespace host::gltf
