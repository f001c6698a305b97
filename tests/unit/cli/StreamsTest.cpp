// Standard streams that are closed, full, or pipes that nobody reads: cron jobs, daemons, | head.
#include "RunTool.h"
#include "support/Catch.h"

namespace {

const std::string kRender = "tyndall-render triangle.gltf --size 16x9 --shadow-size 16 ";

} // namespace

TEST_CASE("a note that standard error does not take costs no picture") {
  const tests::ToolFolder folder;
  const tests::ToolResult plain = folder.shell(kRender + "--out plain.png");
  CHECK(plain.exitCode == 0);
  CHECK(plain.err.find("note: ") == 0);
  const std::string picture = folder.read("plain.png");
  CHECK(picture.find("PNG") == 1);
  for (const char* streams : {"2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-", ">/dev/full 2>/dev/full"}) {
    INFO(streams);
    CHECK(folder.shell(kRender + "--out a.png --stats s.json " + streams).exitCode == 0);
    CHECK(folder.read("a.png") == picture);
    CHECK(folder.read("s.json").find("{\n") == 0); // no note in a file that took the stream's number
    folder.shell("rm a.png s.json");
  }
  CHECK(folder.shell("{ " + kRender + "--out a.png 2>&1; echo $? >status; } | true").exitCode == 0);
  CHECK(folder.read("status") == "0\n");
  CHECK(folder.read("a.png") == picture);
}

TEST_CASE("an error that standard error does not take keeps its exit status") {
  const tests::ToolFolder folder;
  for (const char* streams : {"2>&-", "2>/dev/full"}) {
    CHECK(folder.shell(std::string("tyndall-render missing.glb ") + streams).exitCode == 1);
    CHECK(folder.shell(std::string("tyndall-render --no-such-option ") + streams).exitCode == 2);
  }
}

TEST_CASE("a result that standard output does not take is an error, of every tool") {
  const tests::ToolFolder folder;
  const std::string cases[] = {kRender,
                               "tyndall-render --help",
                               "tyndall-make-scenes --help",
                               "tyndall-sequence triangle.gltf --frames 0-0 --size 16x9 --shadow-size 16",
                               "tyndall-bench --help",
                               "tyndall-avsm-bench --help",
                               "tyndall-accuracy",
                               "tyndall-low-rank",
                               "tyndall-look-up"};
  for (const std::string& command : cases) {
    INFO(command);
    const tests::ToolResult full = folder.shell(command + " >/dev/full");
    CHECK(full.exitCode == 1);
    CHECK(full.err.find("standard output: cannot be written: No space left on device") != std::string::npos);
    CHECK(folder.shell(command + " >&-").exitCode == 1);
    CHECK(folder.shell(command + " >&- 2>&-").exitCode == 1);
  }
}

TEST_CASE("scenes are written whatever becomes of the lines about them") {
  const tests::ToolFolder folder;
  for (const char* streams : {"", ">&- 2>&-", ">/dev/full 2>/dev/full"}) {
    CHECK(folder.shell(std::string("tyndall-make-scenes . smoke ") + streams).exitCode == 0);
    CHECK(folder.read("smoke.glb").find("glTF") == 0);
    folder.shell("mv smoke.glb last.glb; [ -f first.glb ] || cp last.glb first.glb");
    CHECK(folder.read("last.glb") == folder.read("first.glb"));
  }
}
