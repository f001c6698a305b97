#include "ProgramFiles.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace host {

namespace {

namespace fs = std::filesystem;

struct KeptFile {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

// What another process removes meanwhile is left out.
std::vector<KeptFile> filesIn(const fs::path& folder) {
  std::vector<KeptFile> files;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure)) {
    std::error_code gone;
    KeptFile file{entry->path(), 0, {}};
    if (!fs::is_regular_file(entry->symlink_status(gone))) continue;
    file.bytes = entry->file_size(gone);
    if (!gone) file.used = entry->last_write_time(gone);
    if (!gone) files.push_back(file);
  }
  return files;
}

std::uint64_t bytesOf(const std::vector<KeptFile>& files) {
  std::uint64_t bytes = 0;
  for (const KeptFile& file : files)
    bytes += file.bytes;
  return bytes;
}

class ProgramFiles {
public:
  ProgramFiles(fs::path folder, std::uint64_t mostBytes)
      : folder_(std::move(folder)), mostBytes_(mostBytes), bytes_(bytesOf(filesIn(folder_))) {}

  // Throws Error.
  std::vector<std::uint8_t> load(const std::string& key) const {
    const fs::path file = folder_ / key;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    std::vector<std::uint8_t> bytes = readFile(file, mostBytes_);
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored); // the last use
    return bytes;
  }

  // Throws Error.
  void save(const std::string& key, const std::vector<std::uint8_t>& bytes) {
    if (bytes.size() > mostBytes_) return;
    bytes_ += bytes.size();
    if (bytes_ > mostBytes_) makeRoom(bytes.size());
    writeText(folder_ / key, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

private:
  // Removes more than it must, so that not every program is a reason to look through all.
  void makeRoom(std::uint64_t bytes) {
    std::vector<KeptFile> files = filesIn(folder_);
    std::sort(files.begin(), files.end(), [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
    const std::uint64_t left = mostBytes_ - std::max(bytes, mostBytes_ / 4);
    bytes_ = bytesOf(files);
    for (const KeptFile& file : files) {
      if (bytes_ <= left) break;
      std::error_code ignored;
      fs::remove(file.path, ignored);
      bytes_ -= file.bytes;
    }
    bytes_ += bytes;
  }

  fs::path folder_;
  std::uint64_t mostBytes_;
  std::uint64_t bytes_; ///< at most: a program that replaces its like is counted twice
};

// Only an absolute path counts (XDG Base Directory Specification).
std::optional<fs::path> absoluteFolder(const char* variable) {
  const char* value = std::getenv(variable);
  if (!value || !fs::path(value).is_absolute()) return std::nullopt;
  return fs::path(value);
}

} // namespace

std::optional<fs::path> programFolder() {
  if (const auto caches = absoluteFolder("XDG_CACHE_HOME")) return *caches / "tyndall" / "programs";
  if (const auto home = absoluteFolder("HOME")) return *home / ".cache" / "tyndall" / "programs";
  return std::nullopt;
}

tyndall::ProgramStore programFiles(const fs::path& folder, std::uint64_t mostBytes) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!fs::is_directory(folder, failure) || access(folder.c_str(), R_OK | W_OK | X_OK) != 0) return {};
  const auto files = std::make_shared<ProgramFiles>(folder, mostBytes);
  tyndall::ProgramStore store;
  store.load = [files](const std::string& key) {
    try {
      return files->load(key);
    } catch (const Error&) {
      return std::vector<std::uint8_t>();
    }
  };
  store.save = [files](const std::string& key, const std::vector<std::uint8_t>& bytes) {
    try {
      files->save(key, bytes);
    } catch (const Error&) { // not kept, then
    }
  };
  return store;
}

} // namespace host
