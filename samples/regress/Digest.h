// A number that tells contents apart (FNV-1a of 64 bits): against accidents, not against malice.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace regress {

class Digest {
public:
  void add(std::string_view bytes);
  void addFile(const std::filesystem::path& file); ///< one that cannot be read counts as a content of its own
  std::uint64_t value() const { return value_; }
  std::string text() const; ///< 16 hexadecimal digits

private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

} // namespace regress
