// One glTF file on its way to a host::Scene: what was read, what it may still allocate, and how it is refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <scene/FileIo.h>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace host::gltf {

/// Bounds on what a file may make the loader do.
inline constexpr std::uint64_t kMaxFileBytes = 0x7fffffff;   ///< of the file and of each file it refers to
inline constexpr std::uint64_t kMaxJsonBytes = 512ULL << 20; ///< of the JSON text
inline constexpr std::uint64_t kDecodedBytes = 512ULL
                                               << 20;     ///< of vertices, indices, key frames and textures: so many,
inline constexpr std::uint64_t kDecodedBytesPerByte = 32; ///< and so many for each byte of the files
inline constexpr int kMaxTextureSize = 16384;             ///< texels per side

struct Bytes {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

class Document {
public:
  explicit Document(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws Error: one line with the file, the place in it and the rule that it breaks.
  [[noreturn]] void refuse(const std::string& where, const std::string& rule) const;

  /// Adds a line to the scene's notes; the same line only once, and no more than a screenful.
  void note(const std::string& where, const std::string& what);

  /// Raises what may be allocated by what a file of that size may need; the same file counts once.
  void addInput(const std::filesystem::path& file, std::uint64_t bytes);

  /// Accounts for an allocation to come; refuses the document once they exceed what its files may need.
  void spend(std::uint64_t bytes, const std::string& where);

  /// The number of elements of a root array such as "accessors".
  std::size_t count(const char* collection) const;

  /// One of them, which must be there.
  const nlohmann::json& element(const char* collection, std::size_t index) const { return json[collection][index]; }
  const nlohmann::json& element(const char* collection, int index) const {
    return element(collection, static_cast<std::size_t>(index));
  }

  /// The index of the scene to show, or -1 if the file has none.
  int shownScene() const { return count("scenes") == 0 ? -1 : json.value("scene", 0); }

  /// Of KHR_lights_punctual.
  std::size_t lightCount() const;

  bool uses(const char* extension) const;

  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::string>& notes() const { return notes_; }

  nlohmann::json json;        ///< the whole document; checked and with whole numbers as integers after check()
  Bytes binaryChunk;          ///< BIN of a .glb; data is null if there is none
  std::vector<Bytes> buffers; ///< as long as their byteLength; data is null for a buffer without a source

  std::vector<std::uint8_t> fileBytes;                 ///< what binaryChunk points into
  std::vector<std::vector<std::uint8_t>> ownedBuffers; ///< what other buffers point into

private:
  std::filesystem::path file_;
  std::vector<std::string> notes_;
  std::set<std::filesystem::path> inputs_;
  std::uint64_t budget_ = kDecodedBytes;
};

/// The name that an element has, empty if it has none.
std::string nameOf(const nlohmann::json& element);

/// "accessors[3]" and "accessors[3].count".
std::string at(std::string_view collection, std::size_t index, std::string_view member = {});

} // namespace host::gltf
