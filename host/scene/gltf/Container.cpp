#include "Container.h"

#include <cstring>
#include <scene/Json.h>

namespace host::gltf {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

std::uint32_t littleEndian32(const std::uint8_t* p) {
  return std::uint32_t{p[0]} | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 | std::uint32_t{p[3]} << 24;
}

bool beginsAsGlb(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 4 && littleEndian32(bytes.data()) == kMagic;
}

/// Splits a GLB and returns its JSON chunk.
Bytes splitGlb(Document& document) {
  const std::vector<std::uint8_t>& bytes = document.fileBytes;
  if (bytes.size() < kHeaderSize) document.refuse("GLB header", "12 bytes long; the file ends before");
  const std::uint32_t version = littleEndian32(&bytes[4]);
  const std::uint32_t length = littleEndian32(&bytes[8]);
  if (version != 2) document.refuse("GLB header", "version " + std::to_string(version) + ", must be 2");
  if (length > bytes.size()) {
    document.refuse("GLB header", "length " + std::to_string(length) + " exceeds the file's " +
                                      std::to_string(bytes.size()) + " bytes");
  }
  if (length < bytes.size()) document.note("GLB header", "bytes after the declared length are ignored");

  Bytes json;
  std::size_t offset = kHeaderSize;
  for (int chunk = 0; offset < length; ++chunk) {
    const std::string where = "GLB chunk " + std::to_string(chunk);
    if (length - offset < kChunkHeaderSize) document.refuse(where, "its header exceeds the GLB's length");
    const std::uint32_t size = littleEndian32(&bytes[offset]);
    const std::uint32_t type = littleEndian32(&bytes[offset + 4]);
    offset += kChunkHeaderSize;
    if (size > length - offset) document.refuse(where, "its length exceeds the GLB's");
    if (size % 4 != 0) document.refuse(where, "its length must be a multiple of 4");
    if (chunk == 0 && type != kJsonChunk) document.refuse(where, "the first chunk must be JSON");
    if (chunk > 0 && type == kJsonChunk) document.refuse(where, "there must be one JSON chunk only");
    if (chunk > 1 && type == kBinChunk) document.refuse(where, "the BIN chunk must be the second and the only one");
    if (type == kJsonChunk) json = {bytes.data() + offset, size};
    if (type == kBinChunk) document.binaryChunk = {bytes.data() + offset, size};
    offset += size;
  }
  if (json.size == 0) document.refuse("GLB", "has no JSON chunk, or an empty one");
  return json;
}

nlohmann::json parseJson(const Document& document, Bytes text) {
  if (text.size > kMaxJsonBytes) document.refuse("JSON", "longer than " + std::to_string(kMaxJsonBytes >> 20) + " MiB");
  if (text.size >= 3 && std::memcmp(text.data, "\xEF\xBB\xBF", 3) == 0) {
    document.refuse("JSON", "must not begin with a byte order mark");
  }
  try {
    return host::parseJson<nlohmann::json>({reinterpret_cast<const char*>(text.data), text.size});
  } catch (const Error& error) {
    document.refuse("JSON", error.what());
  }
}

} // namespace

void readContainer(Document& document) {
  document.fileBytes = readFile(document.file(), kMaxFileBytes);
  document.addInput(document.file(), document.fileBytes.size());
  const std::vector<std::uint8_t>& bytes = document.fileBytes;
  if (bytes.empty()) document.refuse("", "the file is empty");
  const bool isGlb = beginsAsGlb(bytes);
  if (!isGlb && document.file().extension() == ".glb") document.refuse("GLB header", "must begin with \"glTF\"");
  document.json = parseJson(document, isGlb ? splitGlb(document) : Bytes{bytes.data(), bytes.size()});
  if (!document.json.is_object()) document.refuse("JSON", "the root must be an object");
}

} // namespace host::gltf
