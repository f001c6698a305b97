// Linked GL programs, kept as files from one run of a tool to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <tyndall/tyndall.h>

namespace host {

/// tyndall/programs in the user's folder for caches, $XDG_CACHE_HOME or else ~/.cache; none if neither is known.
std::optional<std::filesystem::path> programFolder();

/// A store that keeps each program in a file of the folder, which is made if need be. Where nothing can be written
/// there it keeps none. Several processes may share a folder: a file holds all of a program or is not there. The
/// programs that were not used for the longest time go when there would be more than `mostBytes`.
tyndall::ProgramStore programFiles(const std::filesystem::path& folder, std::uint64_t mostBytes = 64U << 20);

} // namespace host
