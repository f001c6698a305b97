// Whole files in, whole files out, and text that is fit for a one-line message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace host {

/// The bytes of a regular file of at most `maxBytes`; throws Error.
std::vector<std::uint8_t> readFile(const std::filesystem::path& file, std::uint64_t maxBytes);

/// Calls write(path) with the path of a temporary file beside `file`, then renames it to `file`. If anything is thrown
/// the temporary file is removed and `file` stays as it was; the Error names `file`.
void writeAndRename(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// The text with control characters replaced, cut to a line's length.
std::string printable(std::string_view text);

} // namespace host
