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

std::vector<std::uint8_t> loadDataUri(const std::string& uri) {
  std::vector<std::uint8_t> bytes;
  std::string mimeType;
  if (!tinygltf::IsDataURI(uri)) throw Error("a data URI must be base64 of a buffer or an image");
  if (!tinygltf::DecodeDataURI(&bytes, mimeType, uri, 0, false)) throw Error("the data URI holds no base64 data");
  return bytes;
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
