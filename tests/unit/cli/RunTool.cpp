#include "RunTool.h"

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace tests {

namespace {

constexpr const char* kTriangle = R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]
})";

std::string contentOf(const std::filesystem::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

/// Where the tools lie.
std::filesystem::path binFolder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

/// In the child process: becomes the command, or ends.
[[noreturn]] void become(const std::filesystem::path& folder, std::vector<std::string> command, int out, int err) {
  command.insert(command.begin(), {"timeout", "600"});
  std::vector<char*> pointers;
  for (std::string& part : command)
    pointers.push_back(part.data());
  pointers.push_back(nullptr);
  const char* path = getenv("PATH"); // NOLINT(concurrency-mt-unsafe): a child has one thread
  setenv("PATH", (binFolder().string() + ":" + (path ? path : "/usr/bin:/bin")).c_str(), 1); // NOLINT
  // Not the user's: linked programs, and Mesa's shaders.
  setenv("XDG_CACHE_HOME", (binFolder().parent_path() / "test-cache").c_str(), 1); // NOLINT
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(folder.c_str()) == 0 && dup2(nothing, 0) == 0 && dup2(out, 1) == 1 && dup2(err, 2) == 2)
    execvp("timeout", pointers.data());
  _exit(125);
}

} // namespace

std::vector<std::string> ToolResult::errLines() const {
  std::vector<std::string> lines;
  std::istringstream stream(err);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

ToolFolder::ToolFolder() { write("triangle.gltf", kTriangle); }

void ToolFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string ToolFolder::read(const std::string& name) const { return contentOf(path(name)); }

std::vector<std::string> ToolFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

ToolResult ToolFolder::run(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), (binFolder() / "tyndall-render").string());
  return runCommand(arguments);
}

ToolResult ToolFolder::shell(const std::string& command) const { return runCommand({"sh", "-c", command}); }

ToolResult ToolFolder::runCommand(const std::vector<std::string>& command) const {
  const std::string outName = folder_.path().string() + ".out";
  const std::string errName = folder_.path().string() + ".err";
  const int out = open(outName.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const int err = open(errName.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const pid_t child = fork();
  if (child == 0) become(folder_.path(), command, out, err);
  int status = 0;
  waitpid(child, &status, 0);
  close(out);
  close(err);
  ToolResult result;
  if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  result.out = contentOf(outName);
  result.err = contentOf(errName);
  std::filesystem::remove(outName);
  std::filesystem::remove(errName);
  return result;
}

} // namespace tests
