// Linked programs in files: whole, bounded, and without where there can be none.
#include "GltfFile.h"
#include "support/Catch.h"

#include <chrono>
#include <cstdlib>
#include <scene/ProgramFiles.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {

namespace {

using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

std::uint64_t bytesIn(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    bytes += entry.file_size();
  return bytes;
}

void makeOlder(const fs::path& file, int seconds) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

/// A variable of the environment, as it was when this goes.
class Variable {
public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

private:
  // NOLINTBEGIN(concurrency-mt-unsafe): tests have one thread
  void set(const char* value) const { value ? setenv(name_, value, 1) : unsetenv(name_); }
  // NOLINTEND(concurrency-mt-unsafe)

  const char* name_;
  std::optional<std::string> old_;
};

} // namespace

TEST_CASE("A program that was kept is found again, by others too", "[programs]") {
  const TemporaryFolder folder;
  const fs::path programs = folder / "a" / "b";
  const tyndall::ProgramStore store = host::programFiles(programs);
  REQUIRE(store.load);
  REQUIRE(store.save);
  CHECK(store.load("key").empty());
  const Bytes bytes = {0, 255, 10, 13, 26};
  store.save("key", {1, 2, 3});
  store.save("key", bytes);
  CHECK(store.load("key") == bytes);
  CHECK(host::programFiles(programs).load("key") == bytes);
  CHECK(store.load("yek").empty());
  CHECK(bytesIn(programs) == bytes.size());
}

TEST_CASE("What stands in a program's place and is none is not found", "[programs]") {
  const TemporaryFolder folder;
  const tyndall::ProgramStore store = host::programFiles(folder.path(), 100);
  fs::create_directory(folder / "folder");
  fs::create_symlink("nowhere", folder / "link");
  writeBytes(folder / "long", Bytes(101));
  for (const char* key : {"folder", "link", "long"})
    CHECK(store.load(key).empty());
  store.save("folder", {1}); // cannot be written
  CHECK(store.load("folder").empty());
}

TEST_CASE("No more bytes are kept than may be, and those used last stay", "[programs]") {
  const TemporaryFolder folder;
  constexpr std::uint64_t kMost = 1000;
  writeBytes(folder / "leftover", Bytes(150)); // of an earlier run
  makeOlder(folder / "leftover", 2000);
  const tyndall::ProgramStore store = host::programFiles(folder.path(), kMost);
  for (int i = 0; i < 30; ++i) {
    const std::string key = "key" + std::to_string(i);
    store.save(key, Bytes(100, static_cast<std::uint8_t>(i)));
    CHECK(bytesIn(folder.path()) <= kMost);
    CHECK(store.load(key) == Bytes(100, static_cast<std::uint8_t>(i)));
    makeOlder(folder / key, 1000 - i);
    if (i > 0) CHECK_FALSE(store.load("key0").empty()); // used all the time
  }
  CHECK_FALSE(fs::exists(folder / "leftover"));
  CHECK(store.load("key1").empty());
  CHECK_FALSE(store.load("key28").empty());
  store.save("large", Bytes(kMost + 1));
  CHECK(store.load("large").empty());
  CHECK_FALSE(store.load("key29").empty());
}

TEST_CASE("Processes that keep the same program at once leave it whole", "[programs]") {
  const TemporaryFolder folder;
  constexpr std::size_t kSize = 20000;
  std::vector<pid_t> children;
  for (int writer = 1; writer <= 3; ++writer) {
    const pid_t child = fork();
    if (child == 0) {
      const tyndall::ProgramStore store = host::programFiles(folder.path(), 3 * kSize); // files come and go
      for (int i = 0; i < 200; ++i) {
        store.save("key", Bytes(kSize, static_cast<std::uint8_t>(writer)));
        store.save("key" + std::to_string(writer), Bytes(kSize, static_cast<std::uint8_t>(writer)));
      }
      _exit(0);
    }
    children.push_back(child);
  }
  const tyndall::ProgramStore store = host::programFiles(folder.path());
  std::size_t found = 0, broken = 0;
  while (!children.empty()) {
    const Bytes bytes = store.load("key");
    if (!bytes.empty()) {
      ++found;
      broken += bytes != Bytes(kSize, bytes.front());
    }
    int status = 0;
    if (waitpid(children.back(), &status, WNOHANG) == 0) continue;
    CHECK(status == 0);
    children.pop_back();
  }
  CHECK(found > 0);
  CHECK(broken == 0);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    CHECK(entry.path().extension() != ".part");
}

TEST_CASE("Where nothing can be written there is no store", "[programs]") {
  const TemporaryFolder folder;
  writeBytes(folder / "file", {1});
  std::vector<fs::path> places = {folder / "file", folder / "file" / "programs", "/proc/self/tyndall"};
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  if (geteuid() != 0) places.insert(places.end(), {folder / "locked", folder / "locked" / "programs"});
  for (const fs::path& place : places) {
    CAPTURE(place);
    const tyndall::ProgramStore store = host::programFiles(place);
    CHECK_FALSE(store.load);
    CHECK_FALSE(store.save);
  }
}

TEST_CASE("Programs lie in the user's folder for caches", "[programs]") {
  const Variable home("HOME", "/home/somebody");
  {
    const Variable caches("XDG_CACHE_HOME", "/caches");
    CHECK(host::programFolder() == fs::path("/caches/tyndall/programs"));
  }
  for (const char* value : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Variable caches("XDG_CACHE_HOME", value);
    CHECK(host::programFolder() == fs::path("/home/somebody/.cache/tyndall/programs"));
    const Variable none("HOME", value);
    CHECK_FALSE(host::programFolder());
  }
}

} // namespace tests
