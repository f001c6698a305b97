#include "Document.h"

#include <algorithm>
#include <scene/Error.h>

namespace host::gltf {

namespace {
constexpr std::size_t kMaxNotes = 50;
} // namespace

void Document::refuse(const std::string& where, const std::string& rule) const {
  throw Error(printable(file_.string()) + ": " + printable(where.empty() ? rule : where + ": " + rule));
}

void Document::note(const std::string& where, const std::string& what) {
  std::string line = printable(where + ": " + what);
  if (notes_.size() > kMaxNotes || std::find(notes_.begin(), notes_.end(), line) != notes_.end()) return;
  if (notes_.size() == kMaxNotes) line = "further notes are left out";
  notes_.push_back(std::move(line));
}

void Document::addInput(const std::filesystem::path& file, std::uint64_t bytes) {
  if (inputs_.insert(file.lexically_normal()).second) budget_ += kDecodedBytesPerByte * bytes;
}

void Document::spend(std::uint64_t bytes, const std::string& where) {
  if (bytes > budget_) {
    refuse(where, "would need " + std::to_string(bytes >> 20) + " MiB, of which " + std::to_string(budget_ >> 20) +
                      " MiB are left for a file of this size");
  }
  budget_ -= bytes;
}

std::size_t Document::count(const char* collection) const {
  const auto found = json.find(collection);
  return found == json.end() ? 0 : found->size();
}

std::size_t Document::lightCount() const {
  const auto extensions = json.find("extensions");
  if (extensions == json.end() || !extensions->contains("KHR_lights_punctual")) return 0;
  return (*extensions)["KHR_lights_punctual"]["lights"].size();
}

bool Document::uses(const char* extension) const {
  const auto used = json.find("extensionsUsed");
  return used != json.end() && std::find(used->begin(), used->end(), extension) != used->end();
}

std::string nameOf(const nlohmann::json& element) {
  const auto name = element.find("name");
  return name != element.end() && name->is_string() ? name->get<std::string>() : std::string();
}

std::string at(std::string_view collection, std::size_t index, std::string_view member) {
  std::string path(collection);
  path += '[' + std::to_string(index) + ']';
  if (!member.empty()) path.append(".").append(member);
  return path;
}

} // namespace host::gltf
