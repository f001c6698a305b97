// A reference: NAME.exr, and NAME.json that says what it was made by. The EXR is written first: without a JSON that
// fits, it is half a reference.
#pragma once

#include "CaseList.h"
#include "HdrPicture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace regress {

/// What made a picture.
struct Origin {
  std::string driver;
  std::string context;
  std::string commit; ///< empty: not known
};

struct Reference {
  HdrPicture picture;
  Origin origin;
  std::vector<std::string> words; ///< the case's options when it was recorded
};

class References {
public:
  explicit References(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Whether any file of it exists.
  bool exists(const std::string& name) const;

  /// Throws host::Error if it is missing, half, damaged, of another format or of another size.
  Reference read(const Case& one) const;

  /// Throws host::Error; what is there is replaced.
  void write(const Case& one, const HdrPicture& picture, const Origin& origin) const;

  /// Changes with the reference's files; 0 where one is missing.
  std::uint64_t digestOf(const std::string& name) const;

  std::filesystem::path pictureFile(const std::string& name) const { return folder_ / (name + ".exr"); }
  std::filesystem::path sidecarFile(const std::string& name) const { return folder_ / (name + ".json"); }

private:
  std::filesystem::path folder_;
};

} // namespace regress
