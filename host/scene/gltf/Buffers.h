// Where a glTF file's bytes come from: the BIN chunk, data URIs, and files beside it.
#pragma once

#include "Document.h"

namespace host::gltf {

/// The bytes behind a URI: base64 data, or a file in the document's folder or below. Throws Error with the reason alone
/// (no file or path before it) for other schemes, absolute paths, paths that leave the folder, and unreadable files.
std::vector<std::uint8_t> loadUri(Document& document, const std::string& uri);

/// The document's file and those that its buffers and images name, whether they can be read or not.
std::vector<std::filesystem::path> filesOf(const Document& document);

/// Sets document.buffers. Refuses a buffer that cannot be read or is shorter than its byteLength; one without any
/// source stays null and is refused when something is read from it.
void loadBuffers(Document& document);

} // namespace host::gltf
