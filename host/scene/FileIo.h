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

/// The file that a name stands for behind symbolic links, whether it exists or not.
std::filesystem::path targetOf(const std::filesystem::path& file);

/// The same for two names exactly if they are the same file, whether it exists or not: links and ./ do not matter.
std::string identityOf(const std::filesystem::path& file);

/// Throws Error, which names the file, if it could not be written now: its folder is missing or locked, or it exists
/// and is a folder, a device or write-protected. Leaves nothing behind.
void requireWritable(const std::filesystem::path& file);

/// Calls write(path) with the path of a temporary file beside the file, then renames it: the file holds all or what it
/// held before. A symbolic link stays, and what it leads to is written; permissions stay. If anything is thrown the
/// temporary file is removed; the Error names `file`. One file at a time.
void writeAndRename(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

/// The same with a text.
void writeText(const std::filesystem::path& file, std::string_view text);

/// From now on signals that end the process remove an unfinished file first.
void removeUnfinishedOnSignals();

/// Such a signal's handler.
void endWithoutUnfinished(int signal);

/// The text with control characters replaced, cut to a line's length.
std::string printable(std::string_view text);

} // namespace host
