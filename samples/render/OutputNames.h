// The files that a run of tyndall-render will write, judged before it renders.
#pragma once

#include "Options.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace render {

/// Files count as the same whatever their names: by links, ./ and the like.
class OutputNames {
public:
  /// Throws UsageError if two of the outputs, of whatever frames, are the same file, or one of them is the scene or the
  /// medium; host::Error, which names the file, if one cannot be written now. Leaves nothing behind.
  explicit OutputNames(const Options& options);

  /// Throws UsageError if one of the outputs is one of these files, which the scene refers to.
  void requireOthersThan(const std::vector<std::filesystem::path>& files) const;

private:
  void add(const std::string& option, const std::filesystem::path& file);

  std::map<std::string, std::string> taken_; ///< what a file is, as a message names it, by its identity
};

} // namespace render
