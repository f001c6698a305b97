// What tyndall-render does to the files around those that it writes.
#include "RunTool.h"
#include "support/Catch.h"

#include <filesystem>

namespace {

namespace fs = std::filesystem;

const std::string kRender = "tyndall-render triangle.gltf --size 16x9 --shadow-size 16 ";

/// The files' names and contents.
std::vector<std::string> contentsOf(const tests::ToolFolder& folder) {
  std::vector<std::string> contents;
  for (const std::string& name : folder.files()) {
    contents.push_back(name);
    if (fs::is_regular_file(folder.path(name))) contents.push_back(folder.read(name));
  }
  return contents;
}

/// Two lines, exit status 2, and nothing is touched.
void checkSameFile(const tests::ToolFolder& folder, const std::string& arguments, const std::string& mention) {
  const std::vector<std::string> before = contentsOf(folder);
  const tests::ToolResult result = folder.shell(kRender + arguments);
  CAPTURE(arguments, result.err);
  CHECK(result.exitCode == 2);
  CHECK(result.err.find("tyndall-render: " + mention) != std::string::npos);
  CHECK(contentsOf(folder) == before);
}

} // namespace

TEST_CASE("what lies beside an output under a name like its own stays") {
  const tests::ToolFolder folder;
  for (const char* name : {"a.exr.probe", "a.exr.part", ".a.exr.part"})
    folder.write(name, "mine");
  CHECK(folder.shell(kRender + "--out a.exr").exitCode == 0);
  for (const char* name : {"a.exr.probe", "a.exr.part", ".a.exr.part"})
    CHECK(folder.read(name) == "mine");
}

TEST_CASE("an output that is an input is refused, by whatever name") {
  const tests::ToolFolder folder;
  folder.write("m.json", R"({"absorption": [0.1, 0.1, 0.1]})");
  folder.shell("ln -s triangle.gltf soft; ln triangle.gltf hard; ln -s . here; mkdir sub");
  for (const char* name : {"triangle.gltf", "./triangle.gltf", "soft", "hard", "here/triangle.gltf",
                           "sub/../triangle.gltf", "$PWD/triangle.gltf"})
    checkSameFile(folder, std::string("--stats ") + name, "--stats ");
  checkSameFile(folder, "--medium m.json --stats ./m.json", "--stats ./m.json: is the same file as the medium");
  folder.shell("cp triangle.gltf scene.png");
  checkSameFile(folder, "--out a.png --stats ./a.png", "--stats ./a.png: is the same file as --out a.png");
  const tests::ToolResult own = folder.shell("tyndall-render scene.png --size 8x8 --out scene.png");
  CHECK(own.err.find("--out scene.png: is the same file as the scene") != std::string::npos);
}

TEST_CASE("a file that the scene refers to is not written over, used or not") {
  const tests::ToolFolder folder;
  folder.write("scene.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "corners.bin"}],
    "images": [{"uri": "normals%20of%20it.png"}]})");
  folder.shell("head -c 36 /dev/zero >corners.bin; echo picture >'normals of it.png'; ln -s corners.bin link.json");
  const std::vector<std::string> before = contentsOf(folder);
  for (const char* outputs : {"--stats corners.bin", "--stats link.json", "--out './normals of it.png'"}) {
    const tests::ToolResult result = folder.shell(std::string("tyndall-render scene.gltf --size 8x8 ") + outputs);
    CAPTURE(outputs, result.err);
    CHECK(result.exitCode == 2);
    CHECK(result.err.find("is a file of the scene's") != std::string::npos);
    CHECK(contentsOf(folder) == before);
  }
}

TEST_CASE("two outputs that are one file are refused, by whatever names") {
  const tests::ToolFolder folder;
  folder.shell("mkdir sub; ln -s . here; ln -s h.exr soft.exr; echo >old.png; ln old.png other.png; ln -s "
               "/tmp/../$PWD/new.png new.exr");
  checkSameFile(folder, "--out h.exr --out ./h.exr", "--out ./h.exr: is the same file as --out h.exr");
  checkSameFile(folder, "--out h.exr --out sub/../h.exr", "--out ");
  checkSameFile(folder, "--out h.exr --out here/h.exr", "--out ");
  checkSameFile(folder, "--out h.exr --out soft.exr", "--out ");
  checkSameFile(folder, "--out old.png --out other.png", "--out ");
  checkSameFile(folder, "--out new.png --out new.exr", "--out ");
  // Any two frames.
  folder.shell("ln -s a0003.png b0001.png");
  checkSameFile(folder, "--frames 0-3 --out a%04d.png --stats a0002.png",
                "--stats a0002.png: is the same file as --out");
  checkSameFile(folder, "--frames 0-3 --out a%04d.png --out b%04d.png",
                "--out b0001.png: is the same file as --out a0003");
}

TEST_CASE("an output that is a link stays one, and what it leads to is written") {
  const tests::ToolFolder folder;
  folder.shell("mkdir sub; echo old >sub/old.png; ln -s sub/old.png there.png; ln -s sub/new.png nowhere.png; "
               "ln -s there.png twice.png; ln -s loop.png loop.png");
  for (const char* name : {"there.png", "nowhere.png", "twice.png"}) {
    INFO(name);
    CHECK(folder.shell(kRender + "--out " + name).exitCode == 0);
    CHECK(fs::is_symlink(folder.path(name)));
    CHECK(folder.read(name).find("PNG") == 1);
  }
  CHECK(folder.read("sub/new.png") == folder.read("sub/old.png"));
  CHECK(folder.shell(kRender + "--out loop.png").exitCode == 1);
}

TEST_CASE("an output keeps its permissions, and one without write permission is refused, by root, too") {
  const tests::ToolFolder folder;
  folder.shell("echo old >group.png; chmod 640 group.png; echo old >locked.png; chmod 444 locked.png; "
               "ln -s locked.png soft.png; mkfifo pipe.png");
  CHECK(folder.shell("umask 027; " + kRender + "--out group.png --stats new.json").exitCode == 0);
  CHECK(fs::status(folder.path("group.png")).permissions() == fs::perms{0640});
  CHECK(fs::status(folder.path("new.json")).permissions() == fs::perms{0640});
  for (const char* name : {"locked.png", "soft.png"}) {
    const tests::ToolResult result = folder.shell(kRender + "--out " + name);
    CHECK(result.exitCode == 1);
    CHECK(result.err.find(std::string(name) + ": cannot be written: it is write-protected") != std::string::npos);
    CHECK(folder.read("locked.png") == "old\n");
  }
  const tests::ToolResult pipe = folder.shell(kRender + "--out pipe.png");
  CHECK(pipe.exitCode == 1);
  CHECK(pipe.err.find("pipe.png: cannot be written: it is not a regular file") != std::string::npos);
  CHECK(fs::is_fifo(folder.path("pipe.png")));
  // A later frame's, before the first is rendered.
  folder.shell("cp -p locked.png f0002.png");
  CHECK(folder.shell(kRender + "--frames 0-3 --out f%04d.png").exitCode == 1);
  CHECK(!fs::exists(folder.path("f0000.png")));
}

TEST_CASE("a file beyond the size limit is an error of one line, and leaves nothing") {
  const tests::ToolFolder folder;
  folder.write("kept.exr", "old");
  const std::vector<std::string> before = contentsOf(folder);
  for (const char* name : {"new.exr", "kept.exr"}) {
    const tests::ToolResult result = folder.shell(
        "ulimit -f 8; tyndall-render triangle.gltf --size 128x128 --shadow-size 16 --out " + std::string(name));
    CAPTURE(name, result.err);
    CHECK(result.exitCode == 1);
    CHECK(result.err.find(std::string(name) + ": cannot be written") != std::string::npos);
    CHECK(contentsOf(folder) == before);
  }
}
