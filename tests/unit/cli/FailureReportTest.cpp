// What a failing case leaves: this executable runs cases of its own that fail, which no other run selects.
#include "RunTool.h"
#include "support/Catch.h"

#include <reference/Metrics.h>
#include <scene/ImageFile.h>

namespace {

reference::Image plain(double value) {
  reference::Image image(4, 2);
  image.rgb.assign(24, value);
  return image;
}

/// Runs a case in the folder, its pictures into failed/.
tests::ToolResult runCase(const tests::ToolFolder& folder, const std::string& name) {
  return folder.shell("TYNDALL_FAILED_DIR=\"$PWD/failed\" tyndall-unit-tests '" + name + "'");
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

} // namespace

TEST_CASE("--fails: pictures [differ], by 'one' value; twice", "[.fails]") {
  reference::Image image = plain(1);
  image.set(3, 1, {2, 1, 1});
  CHECK(reference::compare(image, image).max == 0);
  CHECK(reference::compare(image, plain(1)).max == 0);
  CHECK(false); // compares nothing of its own
  CHECK(plain(1) == plain(3));
}

TEST_CASE("fails: no picture is compared", "[.fails]") { CHECK(false); }

TEST_CASE("fails: pictures that differ in size", "[.fails]") { CHECK(plain(1) == reference::Image(1, 1)); }

TEST_CASE("a failing case prints the command that runs it alone, and leaves its pictures") {
  const tests::ToolFolder folder;
  const tests::ToolResult result = runCase(folder, "*value; twice");
  CHECK(result.exitCode != 0);

  const std::string command = between(result.out, "run it alone: ", "\n");
  INFO(command);
  const tests::ToolResult again = folder.shell("TYNDALL_FAILED_DIR=\"$PWD/again\" " + command);
  CHECK(again.exitCode == result.exitCode);
  CHECK(between(again.out, "run it alone: ", "\n") == command);
  CHECK(again.out.find("test cases: 1 |") != std::string::npos);

  const std::filesystem::path pictures = between(result.out, "before each failure: ", "\n");
  CHECK(pictures.parent_path() == folder.path("failed"));
  for (const char* name : {"1-got.png", "1-wanted.png", "1-difference.png", "2-got.png", "2-wanted.png"})
    CHECK(std::filesystem::exists(pictures / name));
  CHECK_FALSE(std::filesystem::exists(pictures / "3-got.png"));
  const auto content = [&](const std::string& name) {
    return folder.read(std::filesystem::relative(pictures / name, folder.path("")).string());
  };
  CHECK(content("1-got.png") != content("1-wanted.png"));

  // The one value that differs, in the top row, shows in red.
  std::vector<std::uint8_t> red(24);
  red[9] = 255;
  host::writePng(folder.path("red.png"), 4, 2, red);
  CHECK(content("1-difference.png") == folder.read("red.png"));
}

TEST_CASE("a failing case without pictures of one size shows what there is") {
  const tests::ToolFolder folder;
  const tests::ToolResult none = runCase(folder, "fails: no picture is compared");
  CHECK(none.out.find("run it alone: ") != std::string::npos);
  CHECK(none.out.find("pictures") == std::string::npos);

  const tests::ToolResult sizes = runCase(folder, "fails: pictures that differ in size");
  const std::filesystem::path pictures = between(sizes.out, "before each failure: ", "\n");
  CHECK(std::filesystem::exists(pictures / "1-wanted.png"));
  CHECK_FALSE(std::filesystem::exists(pictures / "1-difference.png"));
}

TEST_CASE("a folder for pictures that cannot be written costs no report") {
  const tests::ToolFolder folder;
  folder.write("failed", "a file");
  const tests::ToolResult result = runCase(folder, "*value; twice");
  CHECK(result.exitCode != 0);
  CHECK(result.out.find("could not be written: ") != std::string::npos);
  CHECK(result.out.find("run it alone: ") != std::string::npos);
}
