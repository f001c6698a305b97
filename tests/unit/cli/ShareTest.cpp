// An animation that several runs draw, one after the other or at once: --share, --resume and --missing.
#include "RunTool.h"
#include "support/Catch.h"

#include <filesystem>

namespace {

namespace fs = std::filesystem;

const std::string kPictures = "--frames 2-7 --size 32x18 --out f%04d.png --out f%04d.exr ";

/// The pendulum's first frames, as small as they get.
std::string render(const std::string& arguments) {
  return "tyndall-render " TYNDALL_SCENES_DIR "/pendulum.glb --shadow-size 64 " + kPictures + arguments;
}

void checkFails(const tests::ToolFolder& folder, const std::string& arguments, const std::string& message) {
  const tests::ToolResult result = folder.shell("tyndall-render triangle.gltf --size 8x8 " + arguments);
  CAPTURE(arguments, result.err);
  CHECK(result.exitCode == 2);
  CHECK(result.err.find("tyndall-render: " + message) == 0);
  CHECK(result.errLines().size() == 2);
}

std::string missingOf(const tests::ToolFolder& folder, const std::string& arguments = "") {
  const tests::ToolResult result = folder.shell(render("--missing " + arguments));
  CHECK(result.err.empty());
  CHECK(result.exitCode == (result.out.empty() ? 0 : 1));
  return result.out;
}

/// Draws all frames at once into this folder, and keeps them in `whole`.
void drawWhole(const tests::ToolFolder& folder) {
  REQUIRE(folder.shell(render("") + " && mkdir whole && mv f* whole").exitCode == 0);
}

} // namespace

TEST_CASE("shares in any order are one run's frames, bit for bit, by the exposure of the first of all") {
  const tests::ToolFolder folder;
  drawWhole(folder);
  for (const char* share : {"3/4", "1/4", "4/4", "2/4"})
    REQUIRE(folder.shell(render(std::string("--share ") + share)).exitCode == 0);
  CHECK(folder.shell("for f in whole/*; do cmp $f ${f#whole/} || exit; done; [ $(ls f* | wc -l) = 12 ]").exitCode == 0);
}

TEST_CASE("a share's frames are drawn, and no others; one of none draws nothing") {
  const tests::ToolFolder folder;
  CHECK(folder.shell(render("--share 2/3")).exitCode == 0);
  CHECK(missingOf(folder) == "2,4-5,7\n");
  CHECK(missingOf(folder, "--share 2/3").empty());
  CHECK(missingOf(folder, "--share 1/3") == "2,5\n");
  const tests::ToolResult none = folder.shell(render("--share 9/9"));
  CHECK(none.exitCode == 0);
  CHECK(missingOf(folder) == "2,4-5,7\n");
}

TEST_CASE("to resume draws what is not there or not whole, and touches nothing else") {
  const tests::ToolFolder folder;
  drawWhole(folder);
  folder.shell("cp -p whole/* . && touch -d 2001-01-01 f*");
  CHECK(missingOf(folder).empty());
  folder.shell("rm f0003.png; head -c 300 whole/f0005.exr >f0005.exr; head -c -1 whole/f0006.png >f0006.png");
  CHECK(missingOf(folder) == "3,5-6\n");
  const tests::ToolResult result = folder.shell(render("--resume"));
  CHECK(result.exitCode == 0);
  CHECK(result.err.find("3 of 6 frames are whole and stay\n") != std::string::npos);
  CHECK(missingOf(folder).empty());
  CHECK(folder.shell("for f in whole/*; do cmp $f ${f#whole/} || exit; done").exitCode == 0);
  CHECK(folder.shell("ls f* | wc -l; find . -maxdepth 1 -name 'f*' ! -newermt 2002-01-01 | wc -l").out == "12\n6\n");
}

TEST_CASE("what is cut, damaged, empty, of another size or kind, or no picture is not whole") {
  const tests::ToolFolder folder;
  drawWhole(folder);
  const char* const damages[] = {
      "head -c 0 $w >$f",
      "head -c 40 $w >$f",
      "head -c -12 $w >$f",
      "head -c -13 $w >$f; tail -c 12 $w >>$f",
      "cp $w $f; printf XXXX | dd of=$f bs=1 seek=$(($(wc -c <$w) * 2 / 3)) conv=notrunc 2>$f.log; rm $f.log",
      "tr '[:print:]' x <$w >$f",
      "rm $f; mkdir $f; :"};
  for (const char* name : {"f0004.png", "f0004.exr"})
    for (const char* damage : damages) {
      CAPTURE(name, damage);
      folder.shell("cp whole/f* .; f=" + std::string(name) + "; w=whole/$f; " + damage);
      CHECK(missingOf(folder) == "4\n");
      folder.shell("rm -r " + std::string(name));
    }
  folder.shell("cp whole/f* .");
  CHECK(missingOf(folder).empty());
  CHECK(missingOf(folder, "--supersample 2") == "2-7\n"); // the EXRs' pixels
  folder.shell("cp whole/f0003.exr f0003.png; cp whole/f0004.png f0004.exr");
  CHECK(missingOf(folder) == "3-4\n");
}

TEST_CASE("where a process left a file under a new process's name for an unfinished one, another name is taken") {
  const tests::ToolFolder folder;
  // sh becomes the tool, and keeps its number.
  const tests::ToolResult result =
      folder.shell("for i in 0 1 2 3 5; do echo mine >.tyndall-$$-$i.part; done; exec tyndall-render triangle.gltf "
                   "--size 8x8 --shadow-size 16 --out a.png --stats s.json");
  CAPTURE(result.err);
  CHECK(result.exitCode == 0);
  CHECK(folder.shell("cat .tyndall-*.part").out == "mine\nmine\nmine\nmine\nmine\n");
  CHECK(fs::exists(folder.path("a.png")));
}

TEST_CASE("options of shares that make no sense are refused in one line") {
  const tests::ToolFolder folder;
  const std::string frames = "--frames 0-3 --out a%04d.png ";
  for (const char* share : {"0/3", "4/3", "1", "1/3/5", "a/3", "1/0", "-1/3", "1/1000001", "1.5/3"})
    checkFails(folder, frames + "--share " + share,
               "--share " + std::string(share) + ": must be K/N, 1 <= K <= N <= 1000000");
  checkFails(folder, "--out a.png --share 1/2", "--share requires --frames");
  checkFails(folder, "--resume", "--resume requires --out");
  checkFails(folder, "--missing", "--missing requires --out");
  checkFails(folder, "--out a.png --resume --stats s.json", "--resume excludes --stats");
  checkFails(folder, frames + "--detect-changes --share 1/2", "--share excludes --detect-changes");
}
