// Runs tyndall-render as a process of its own, in an empty folder that goes with the test.
#pragma once

#include "support/TemporaryFolder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tests {

struct ToolResult {
  int exitCode = -1; ///< 124: ran past ten minutes; -1: a signal ended it
  std::string out;
  std::string err;

  std::vector<std::string> errLines() const;
};

/// A fresh folder, removed at the end. It holds `triangle.gltf`: corners (-1,-1,0), (1,-1,0), (0,1,0), no camera, no
/// light.
class ToolFolder {
public:
  ToolFolder();

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::vector<std::string> files() const; ///< the names of all that lies in it, sorted

  /// Runs tyndall-render with this folder as the working directory, and the build's for caches.
  ToolResult run(std::vector<std::string> arguments) const;

  /// Runs a shell's command there; all of the project's tools are found by name.
  ToolResult shell(const std::string& command) const;

private:
  ToolResult runCommand(const std::vector<std::string>& command) const;

  TemporaryFolder folder_;
};

} // namespace tests
