#include "FileIo.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <scene/Error.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace host {

namespace {

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

// ---------------------------------------------------------------------------------------------------------------------
// Signals

/// The file to remove if a signal ends the process; empty for none. Only one is written at a time.
char unfinished[PATH_MAX] = "";

void setUnfinished(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (name.size() < sizeof unfinished) std::memcpy(unfinished + 1, name.c_str() + 1, name.size());
  std::atomic_signal_fence(std::memory_order_seq_cst);
  unfinished[0] = name.size() < sizeof unfinished ? name[0] : '\0';
}

void clearUnfinished() { unfinished[0] = '\0'; }

// ---------------------------------------------------------------------------------------------------------------------
// Writing

std::string reasonOf(int error) { return std::generic_category().message(error); }

/// Throws Error with the reason alone if the file, which may not exist yet, is not one to be written.
void checkTarget(const std::filesystem::path& target) {
  const std::filesystem::path folder = folderOf(target);
  struct stat status{};
  if (target.filename().empty() || std::filesystem::is_directory(target)) throw Error("it is a folder");
  if (!std::filesystem::is_directory(folder)) throw Error("its folder does not exist");
  if (stat(target.c_str(), &status) != 0) {
    if (errno != ENOENT) throw Error(reasonOf(errno));
    return;
  }
  if (!S_ISREG(status.st_mode)) throw Error("it is not a regular file");
  // Nothing is forbidden to root, but a file that nobody may write is meant to stay.
  constexpr mode_t kAnyoneWrites = S_IWUSR | S_IWGRP | S_IWOTH;
  if ((status.st_mode & kAnyoneWrites) == 0 || access(target.c_str(), W_OK) != 0) throw Error("it is write-protected");
}

/// A new file in the folder of another one, with that one's permissions if it exists. Removed when it goes out of scope
/// or a signal ends the process, unless it has been renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::filesystem::path& target) {
    const int descriptor = create(target.parent_path());
    if (descriptor < 0) throw Error(reasonOf(errno));
    struct stat status{};
    if (stat(target.c_str(), &status) == 0) {
      // Only root can give a file away: where that fails, it is the writer's.
      if (fchown(descriptor, status.st_uid, status.st_gid) != 0) errno = 0;
      fchmod(descriptor, status.st_mode & 07777);
    }
    close(descriptor);
  }
  ~TemporaryFile() {
    if (!path_.empty()) unlink(path_.c_str());
    clearUnfinished();
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void renameTo(const std::filesystem::path& file) {
    std::filesystem::rename(path_, file);
    path_.clear();
  }

private:
  /// The descriptor, or -1. Another machine's process, or one that was killed, may have had this one's number: names
  /// that are taken are passed over.
  int create(const std::filesystem::path& folder) {
    constexpr int kMostTaken = 10000;
    static int count = 0;
    int descriptor = -1;
    sigset_t all, before; // no signal comes between a file and its being known as unfinished
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    for (int attempt = 0; attempt < kMostTaken; ++attempt) {
      path_ = folder / (".tyndall-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".part");
      descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); // less the umask
      if (descriptor >= 0 || errno != EEXIST) break;
    }
    if (descriptor >= 0) setUnfinished(path_);
    const int error = errno;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    errno = error;
    return descriptor;
  }

  std::filesystem::path path_;
};

/// Calls `action`; what it throws names the file.
void naming(const std::filesystem::path& file, const std::function<void()>& action) {
  try {
    action();
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(printable(file.string()) + ": cannot be written: " + error.code().message());
  } catch (const std::exception& error) {
    throw Error(printable(file.string()) + ": cannot be written: " + printable(error.what()));
  }
}

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

std::filesystem::path targetOf(const std::filesystem::path& file) {
  constexpr int kMostLinks = 40; // as Linux
  std::filesystem::path target = file;
  for (int i = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(target)); ++i) {
    if (i == kMostLinks) throw Error("it is a loop of symbolic links");
    target = target.parent_path() / std::filesystem::read_symlink(target); // an absolute one replaces it all
  }
  return target;
}

std::string identityOf(const std::filesystem::path& file) {
  struct stat status{};
  if (stat(file.c_str(), &status) == 0) return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  try {
    const std::filesystem::path target = targetOf(file);
    return (std::filesystem::canonical(folderOf(target)) / target.filename()).string();
  } catch (const std::exception&) {
    return std::filesystem::absolute(file).lexically_normal().string();
  }
}

void requireWritable(const std::filesystem::path& file) {
  naming(file, [&] {
    const std::filesystem::path target = targetOf(file);
    checkTarget(target);
    const TemporaryFile probe(target);
  });
}

void writeAndRename(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write) {
  naming(file, [&] {
    const std::filesystem::path target = targetOf(file);
    checkTarget(target);
    TemporaryFile temporary(target);
    write(temporary.path());
    temporary.renameTo(target);
  });
}

void writeText(const std::filesystem::path& file, std::string_view text) {
  writeAndRename(file, [text](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    errno = EIO;
    if (!stream.flush()) throw Error(reasonOf(errno));
  });
}

void endWithoutUnfinished(int signal) {
  if (unfinished[0] != '\0') unlink(unfinished);
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  raise(signal);
}

void removeUnfinishedOnSignals() {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU})
    if (std::signal(signal, endWithoutUnfinished) == SIG_IGN) std::signal(signal, SIG_IGN); // nohup, say
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxLength = 300;
  std::string line(text.substr(0, kMaxLength));
  std::replace_if(line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  if (line.size() < text.size()) line += "...";
  return line;
}

} // namespace host
