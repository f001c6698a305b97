// Where a build's files are, also when they were packed to run elsewhere (tests/gpu.sh --bundle).
#pragma once

#include <filesystem>
#include <string>

namespace host {

/// Names the folder of a bundle; not set in a build.
inline constexpr const char* kBundleVariable = "TYNDALL_BUNDLE";

/// A file or folder of the bundle, by its name there, or else the one of the build.
std::filesystem::path placeOf(const std::string& inBundle, const std::filesystem::path& inBuild);

/// The bundle's commit, or else what git says of the folder: "unknown" if nothing.
std::string commitOf(const std::filesystem::path& sources);

} // namespace host
