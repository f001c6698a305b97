// A list of a folder's files, to choose one or to name one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viewer {

class FileDialog {
public:
  /// `endings`: of the files that are listed, in lower case. `name`: of the file to write; empty: one is opened.
  void open(const std::string& title, const std::filesystem::path& folder, std::vector<std::string> endings,
            const std::string& name = {});
  bool isOpen() const { return isOpen_; }
  void cancel() { isCancelled_ = true; }

  /// Draws it while it is open; the file once it is chosen.
  std::optional<std::filesystem::path> draw();

private:
  void enter(const std::filesystem::path& folder);
  bool drawList();
  std::optional<std::filesystem::path> choose();

  std::string title_;
  std::filesystem::path folder_;
  std::vector<std::string> endings_;
  std::vector<std::string> folders_, files_;
  std::string name_;
  std::string problem_;             ///< why the folder cannot be listed, or the file not be taken
  std::filesystem::path confirmed_; ///< is to be replaced if it is chosen again
  bool isOpen_ = false, isNew_ = false, isCancelled_ = false, isSaving_ = false;
};

} // namespace viewer
