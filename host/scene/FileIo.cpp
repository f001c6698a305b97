#include "FileIo.h"

#include <algorithm>
#include <fstream>
#include <scene/Error.h>
#include <unistd.h>

namespace host {

namespace {

/// Removes a file when it goes out of scope, unless it has been renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void renameTo(const std::filesystem::path& file) {
    std::filesystem::rename(path_, file);
    path_.clear();
  }

private:
  std::filesystem::path path_;
};

} // namespace

std::vector<std::uint8_t> readFile(const std::filesystem::path& file, std::uint64_t maxBytes) {
  const auto refuse = [&](const std::string& reason) -> void {
    throw Error(printable(file.string()) + ": cannot be read: " + reason);
  };
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(file, failure);
  if (status.type() == std::filesystem::file_type::none) refuse(failure.message());
  if (!std::filesystem::exists(status)) refuse("no such file");
  if (!std::filesystem::is_regular_file(status)) refuse("not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure) refuse(failure.message());
  if (size > maxBytes) refuse("longer than " + std::to_string(maxBytes) + " bytes");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("no permission");
  std::vector<std::uint8_t> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) refuse("it ends early");
  return bytes;
}

void writeAndRename(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write) {
  const std::string hidden = "." + file.filename().string() + "." + std::to_string(getpid()) + ".part";
  TemporaryFile temporary(file.parent_path() / hidden);
  try {
    if (file.filename().empty() || std::filesystem::is_directory(file)) throw Error("it is a folder");
    if (!file.parent_path().empty() && !std::filesystem::is_directory(file.parent_path())) {
      throw Error("its folder does not exist");
    }
    write(temporary.path());
    temporary.renameTo(file);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(printable(file.string()) + ": cannot be written: " + error.code().message());
  } catch (const std::exception& error) {
    throw Error(printable(file.string()) + ": cannot be written: " + printable(error.what()));
  }
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxLength = 300;
  std::string line(text.substr(0, kMaxLength));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  if (line.size() < text.size()) line += "...";
  return line;
}

} // namespace host
