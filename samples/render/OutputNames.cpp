#include "OutputNames.h"
#include "CommandLine.h"
#include "Outputs.h"

#include <scene/FileIo.h>

namespace render {

OutputNames::OutputNames(const Options& options) {
  taken_[host::identityOf(options.scene)] = "the scene";
  if (options.mediumFile) taken_[host::identityOf(*options.mediumFile)] = "the medium";
  if (options.ambientFile) taken_[host::identityOf(*options.ambientFile)] = "the ambient light";
  if (options.stateFile) taken_[host::identityOf(*options.stateFile)] = "the state";
  for (const std::filesystem::path& pattern : options.out)
    for (const int frame : framesOf(options))
      add("--out", nameOfFrame(pattern, frame));
  if (options.stats) add("--stats", *options.stats);
}

void OutputNames::add(const std::string& option, const std::filesystem::path& file) {
  host::requireWritable(file);
  const auto [taken, isNew] = taken_.emplace(host::identityOf(file), option + " " + file.string());
  if (!isNew) failUsage(option, file.string(), "is the same file as " + taken->second);
}

void OutputNames::requireOthersThan(const std::vector<std::filesystem::path>& files) const {
  for (const std::filesystem::path& file : files) {
    const auto taken = taken_.find(host::identityOf(file));
    if (taken != taken_.end() && taken->second.rfind("--", 0) == 0)
      throw UsageError(taken->second + ": is a file of the scene's, " + file.string());
  }
}

} // namespace render
