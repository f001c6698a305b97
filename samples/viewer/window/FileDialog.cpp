#include "FileDialog.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <imgui.h>
#include <utility>

namespace viewer {

namespace {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

} // namespace

void FileDialog::open(const std::string& title, const std::filesystem::path& folder, std::vector<std::string> endings,
                      const std::string& name) {
  title_ = title;
  endings_ = std::move(endings);
  name_ = name;
  isSaving_ = !name.empty();
  isOpen_ = isNew_ = true;
  isCancelled_ = false;
  confirmed_.clear();
  enter(folder.empty() ? std::filesystem::path(".") : folder);
}

void FileDialog::enter(const std::filesystem::path& folder) {
  std::error_code error;
  folder_ = std::filesystem::absolute(folder, error).lexically_normal();
  folders_ = {".."};
  files_.clear();
  for (auto entry = std::filesystem::directory_iterator(folder_, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ofNoConcern;
    if (entry->is_directory(ofNoConcern)) {
      if (name.front() != '.') folders_.push_back(name);
    } else if (std::find(endings_.begin(), endings_.end(), lowerCase(entry->path().extension().string())) !=
               endings_.end()) {
      files_.push_back(name);
    }
  }
  problem_ = error ? folder_.string() + ": " + error.message() : std::string();
  std::sort(folders_.begin(), folders_.end());
  std::sort(files_.begin(), files_.end());
}

/// Whether a file was clicked twice.
bool FileDialog::drawList() {
  std::filesystem::path entered;
  bool isChosen = false;
  ImGui::BeginChild("files", ImVec2(0, -2.6F * ImGui::GetFrameHeightWithSpacing()), true);
  for (const std::string& name : folders_)
    if (ImGui::Selectable((name + "/").c_str())) entered = folder_ / name;
  for (const std::string& name : files_) {
    if (ImGui::Selectable(name.c_str(), name == name_, ImGuiSelectableFlags_AllowDoubleClick)) {
      name_ = name;
      isChosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    }
  }
  ImGui::EndChild();
  if (!entered.empty()) enter(entered);
  return isChosen;
}

/// The file of that name. One that would be replaced is asked for twice.
std::optional<std::filesystem::path> FileDialog::choose() {
  std::filesystem::path file = folder_ / name_; // an absolute name stays one
  const std::string ending = lowerCase(file.extension().string());
  if (isSaving_ && std::find(endings_.begin(), endings_.end(), ending) == endings_.end()) file += endings_.front();
  std::error_code none;
  if (isSaving_ && file != confirmed_ && std::filesystem::exists(file, none)) {
    confirmed_ = file;
    problem_ = file.filename().string() + " is there: Save again to replace it";
    return std::nullopt;
  }
  isOpen_ = false;
  return file;
}

std::optional<std::filesystem::path> FileDialog::draw() {
  if (!isOpen_) return std::nullopt;
  if (isNew_) ImGui::OpenPopup(title_.c_str());
  const bool isFirst = std::exchange(isNew_, false);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize(ImVec2(std::min(560.0F, 0.95F * display.x), std::min(420.0F, 0.95F * display.y)),
                           ImGuiCond_Appearing);
  ImGui::SetNextWindowPos(ImVec2(0.5F * display.x, 0.5F * display.y), ImGuiCond_Appearing, ImVec2(0.5F, 0.5F));
  std::optional<std::filesystem::path> chosen;
  if (!ImGui::BeginPopupModal(title_.c_str(), &isOpen_)) return chosen;
  ImGui::TextWrapped("%s", problem_.empty() ? folder_.string().c_str() : problem_.c_str());
  bool isDone = drawList();
  std::array<char, 512> text{};
  name_.copy(text.data(), text.size() - 1);
  ImGui::SetNextItemWidth(-1);
  if (isFirst || ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere(); // a name may be typed at once
  if (ImGui::InputText("##name", text.data(), text.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
    isDone = true;
  name_ = text.data();
  ImGui::BeginDisabled(name_.empty());
  if (ImGui::Button(isSaving_ ? "Save" : "Open")) isDone = true;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || isCancelled_) isOpen_ = false;
  if (isDone && !name_.empty()) chosen = choose();
  if (!isOpen_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

} // namespace viewer
