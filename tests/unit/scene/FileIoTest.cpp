// Whole files or none: what is left when writing ends early.
#include "GltfFile.h"
#include "support/Catch.h"

#include <array>
#include <csignal>
#include <fstream>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {

namespace {

/// The signal that ended a child which got `signal` in the midst of writing; 0 if it ended otherwise.
int endOfWriter(const std::filesystem::path& file, int signal) {
  const pid_t child = fork();
  if (child == 0) {
    host::removeUnfinishedOnSignals();
    host::writeAndRename(file, [signal](const std::filesystem::path& temporary) {
      std::ofstream(temporary) << "half" << std::flush;
      raise(signal);
    });
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

std::string contentOf(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readBytes(file);
  return {bytes.begin(), bytes.end()};
}

std::size_t countIn(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator files(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

} // namespace

TEST_CASE("A signal in the midst of writing ends the process and leaves no unfinished file", "[files]") {
  const TemporaryFolder folder;
  host::writeText(folder / "old", "whole");
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU})
    for (const char* name : {"old", "new"}) {
      CHECK(endOfWriter(folder / name, signal) == signal);
      CHECK(countIn(folder.path()) == 1);
      CHECK(contentOf(folder / "old") == "whole");
    }
}

TEST_CASE("What is thrown in the midst of writing leaves the file as it was", "[files]") {
  const TemporaryFolder folder;
  host::writeText(folder / "old", "whole");
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("enough");
  };
  for (const char* name : {"old", "new"})
    CHECK_THROWS_WITH(host::writeAndRename(folder / name, fail), Catch::Contains("cannot be written: enough"));
  CHECK(countIn(folder.path()) == 1);
  CHECK(contentOf(folder / "old") == "whole");
}

TEST_CASE("A name as long as there may be is written", "[files]") {
  const TemporaryFolder folder;
  const std::filesystem::path longest = folder / std::string(255, 'n');
  host::writeText(longest, "whole");
  CHECK(contentOf(longest) == "whole");
  CHECK_THROWS_WITH(host::requireWritable(folder / std::string(256, 'n')), Catch::Contains("File name too long"));
}

TEST_CASE("Names of one file have one identity", "[files]") {
  const TemporaryFolder folder;
  host::writeText(folder / "file", "");
  std::filesystem::create_symlink("file", folder / "soft");
  std::filesystem::create_hard_link(folder / "file", folder / "hard");
  std::filesystem::create_symlink("missing", folder / "dangling");
  for (const char* name : {"./file", "soft", "hard"})
    CHECK(host::identityOf(folder / name) == host::identityOf(folder / "file"));
  CHECK(host::identityOf(folder / "dangling") == host::identityOf(folder / "./missing"));
  CHECK(host::identityOf(folder / "missing") != host::identityOf(folder / "file"));
}

} // namespace tests
