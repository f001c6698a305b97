// Small glTF files made in a test.
#pragma once

#include "support/TemporaryFolder.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <scene/Scene.h>
#include <string>
#include <vector>

namespace tests {

std::vector<std::uint8_t> readBytes(const std::filesystem::path& file);
void writeBytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes);

/// A glTF document with one buffer, built up value by value.
class GltfFile {
public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::uint8_t> bytes;

  /// Adds a buffer view of the values, and returns its index.
  template <typename T>
  int view(const std::vector<T>& values, int stride = 0) {
    return addView(reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T), stride);
  }

  /// Adds an accessor, and returns its index; view -1 is none.
  int accessor(int view, int componentType, const char* type, std::size_t count, std::size_t offset = 0);

  /// A float accessor of tightly packed values.
  int floats(const std::vector<float>& values, const char* type, std::size_t components);

  /// Adds a mesh of one primitive, a node that shows it, and a scene with that node if there is none yet.
  void show(const nlohmann::json& primitive);

  std::vector<std::uint8_t> glb() const;

  /// Writes it as a .glb into a folder of its own, and loads that.
  host::Scene load() const;

  /// The message with which loading is refused; fails the test if it is not.
  std::string refusal() const;

private:
  int addView(const std::uint8_t* data, std::size_t size, int stride);
};

/// Whether a note contains the text.
bool hasNote(const host::Scene& scene, const std::string& text);

/// A file that uses everything the loader reads: interleaved, sparse, quantised and indexed geometry, a texture, two
/// cameras, three lights, a hierarchy, all three interpolations, glass, a medium and a sky.
GltfFile everything();

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

} // namespace tests
