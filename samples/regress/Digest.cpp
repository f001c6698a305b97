#include "Digest.h"

#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace regress {

void Digest::add(std::string_view bytes) {
  const auto mix = [&](unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3ULL; };
  for (const char byte : bytes)
    mix(static_cast<unsigned char>(byte));
  mix(0xff); // "a" and "bc" are not "ab" and "c"
}

void Digest::addFile(const std::filesystem::path& file) {
  constexpr std::uint64_t kMostBytes = 1ULL << 32;
  try {
    const std::vector<std::uint8_t> bytes = host::readFile(file, kMostBytes);
    add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const host::Error& error) {
    add(error.what());
  }
}

std::string Digest::text() const { return fmt::format("{:016x}", value_); }

} // namespace regress
