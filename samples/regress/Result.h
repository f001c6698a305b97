// What became of a case: OUT/results/NAME.json, written last, so that a case has a result or is still to do.
#pragma once

#include "CaseList.h"
#include "Compare.h"
#include "Reference.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace regress {

enum class Verdict {
  Same,      ///< within the tolerance
  Different, ///< beyond it
  Failed     ///< not rendered, or nothing to compare with
};
const char* nameOf(Verdict verdict);

struct Result {
  std::string name;
  Verdict verdict = Verdict::Failed;
  std::string message;            ///< why it failed
  std::vector<std::string> notes; ///< of rendering and comparison
  std::optional<Difference> difference;
  Tolerance tolerance;
  std::vector<std::string> words;
  double range = 0;                  ///< of the colours of the difference's picture
  bool isEqual = false;              ///< to the last bit
  std::vector<std::string> pictures; ///< of "got", "wanted", "difference": those that were written
  Origin origin, recorded;
  double seconds = 0;
  std::string inputs; ///< digest of all that it depends on but the driver

  /// How much of its tolerance the worst figure takes; infinite for what failed.
  double badness() const;
};

/// A line for people: the verdict and what it is from.
std::string summaryOf(const Result& result);

class Results {
public:
  explicit Results(std::filesystem::path out) : out_(std::move(out)) {}

  /// Makes the folders. Throws host::Error if they cannot be written.
  void prepare() const;

  /// None if there is none, or none that is whole.
  std::optional<Result> find(const std::string& name) const;
  bool exists(const std::string& name) const;
  void write(const Result& result) const;
  void remove(const std::string& name) const;
  void removeReport() const; ///< which tells of other results

  std::filesystem::path pictureFile(const std::string& name, const std::string& kind) const {
    return out_ / "pictures" / (name + "." + kind + ".png");
  }
  std::filesystem::path reportFile() const { return out_ / "report.html"; }
  std::filesystem::path junitFile() const { return out_ / "junit.xml"; }

private:
  std::filesystem::path file(const std::string& name) const { return out_ / "results" / (name + ".json"); }

  std::filesystem::path out_;
};

} // namespace regress
