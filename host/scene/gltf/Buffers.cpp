#include "Buffers.h"

#include <algorithm>
#include <scene/Error.h>

namespace host::gltf {

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Padding at the end may be missing.
std::vector<std::uint8_t> base64Decoded(std::string_view text) {
  text = text.substr(0, text.find_last_not_of('=') + 1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) throw Error("the data URI holds a character that base64 does not have");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  if (bytes.empty()) throw Error("the data URI holds no base64 data");
  return bytes;
}

std::string percentDecoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) throw Error("\"" + printable(uri) + "\" has a % that two hexadecimal digits must follow");
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

/// The path, relative to the document's folder, that a URI names. Backslashes count as slashes.
std::filesystem::path relativePath(const std::string& uri) {
  const std::string quoted = "\"" + printable(uri) + "\"";
  if (uri.substr(0, uri.find('/')).find(':') != std::string::npos) {
    throw Error(quoted + " must be a relative path or base64 data; other schemes are not read");
  }
  std::string text = percentDecoded(uri);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.empty() || text.find('\0') != std::string::npos) throw Error(quoted + " names no file");
  std::filesystem::path path = std::filesystem::path(text).lexically_normal();
  if (path.is_absolute()) throw Error(quoted + " must not be an absolute path");
  if (*path.begin() == "..") throw Error(quoted + " must not lead out of the file's folder");
  return path;
}

std::vector<std::uint8_t> loadDataUri(std::string_view uri) {
  for (const char* type : {"application/octet-stream", "application/gltf-buffer", "image/png", "image/jpeg",
                           "image/gif", "image/bmp", "text/plain"}) {
    const std::string head = std::string("data:") + type + ";base64,";
    if (uri.substr(0, head.size()) == head) return base64Decoded(uri.substr(head.size()));
  }
  throw Error("a data URI must be base64 of a buffer or an image");
}

void loadBuffer(Document& document, std::size_t index) {
  const nlohmann::json& json = document.json["buffers"][index];
  const auto length = json["byteLength"].get<std::size_t>();
  Bytes bytes;
  if (json.contains("uri")) {
    const std::string where = at("buffers", index, "uri");
    try {
      document.ownedBuffers.push_back(loadUri(document, json["uri"].get_ref<const std::string&>()));
    } catch (const Error& error) {
      document.refuse(where, error.what());
    }
    bytes = {document.ownedBuffers.back().data(), document.ownedBuffers.back().size()};
  } else if (index == 0) {
    bytes = document.binaryChunk;
    // The chunk is padded to a multiple of 4 bytes.
    if (bytes.data != nullptr && bytes.size > length + 3) {
      document.note(at("buffers", index, "byteLength"), "the BIN chunk is longer; its rest is ignored");
    }
  }
  if (bytes.data != nullptr && bytes.size < length) {
    document.refuse(at("buffers", index, "byteLength"),
                    "is " + std::to_string(length) + ", but there are " + std::to_string(bytes.size) + " bytes");
  }
  document.buffers.push_back({bytes.data, bytes.data == nullptr ? 0 : length});
}

} // namespace

std::vector<std::uint8_t> loadUri(Document& document, const std::string& uri) {
  if (uri.rfind("data:", 0) == 0) return loadDataUri(uri);
  const std::filesystem::path file = document.file().parent_path() / relativePath(uri);
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (!failure && size <= kMaxFileBytes) {
    document.addInput(file, size);
    document.spend(size, "\"" + uri + "\"");
  }
  return readFile(file, kMaxFileBytes);
}

std::vector<std::filesystem::path> filesOf(const Document& document) {
  std::vector<std::filesystem::path> files = {document.file()};
  for (const char* collection : {"buffers", "images"}) {
    for (std::size_t i = 0; i < document.count(collection); ++i) {
      const auto uri = document.json[collection][i].value("uri", std::string("data:"));
      if (uri.rfind("data:", 0) == 0) continue;
      try {
        files.push_back(document.file().parent_path() / relativePath(uri));
      } catch (const Error&) {
        continue; // names no file that is looked for
      }
    }
  }
  return files;
}

void loadBuffers(Document& document) {
  const std::size_t count = document.count("buffers");
  for (std::size_t i = 0; i < count; ++i) {
    loadBuffer(document, i);
  }
}

} // namespace host::gltf
