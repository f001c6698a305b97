// A folder with a small list of cases, for tyndall-regress as a process of its own.
#pragma once

#include "unit/cli/RunTool.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tests {

class SuiteFolder {
public:
  /// cases.json holds these cases, each drawn small.
  explicit SuiteFolder(const nlohmann::json& cases);

  const ToolFolder& folder() const { return folder_; }
  void writeCases(const nlohmann::json& cases) const;

  /// The tool with list and references; `arguments` follow, `before` may set the environment.
  ToolResult record(const std::string& arguments = "", const std::string& before = "") const;
  ToolResult check(const std::string& arguments = "", const std::string& before = "") const; ///< into the folder out
  ToolResult report(const std::string& arguments = "") const;

  /// out/results/NAME.json.
  nlohmann::json result(const std::string& name, const std::string& out = "out") const;

private:
  ToolResult run(const std::string& command, const std::string& arguments, const std::string& before) const;

  ToolFolder folder_;
};

/// Two cases that are drawn in a moment.
nlohmann::json twoCases();

/// A line of the text that begins with `begin` and mentions `mention`.
bool hasLine(const std::string& text, const std::string& begin, const std::string& mention);

} // namespace tests
