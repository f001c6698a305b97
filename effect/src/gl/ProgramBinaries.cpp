#include "gl/ProgramBinaries.h"

#include "gl/Hash.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tyndall::gl {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kMagic = 0x50594e54; // "TYNP"

// What precedes the driver's bytes.
struct Header {
  std::uint32_t magic = kMagic;
  Enum format = 0;
  std::uint64_t length = 0;
  std::uint64_t checksum = 0;
};

// Of another key it is another: bytes that were kept under a wrong name do not pass.
std::uint64_t checksumOf(const std::string& key, const std::uint8_t* bytes, std::size_t size) {
  Hash hash;
  hash.add(key);
  hash.add(bytes, size);
  return hash.low();
}

} // namespace

void ProgramBinaries::askDriver() {
  asked_ = true;
  if (!store_.load || !store_.save || !gl_.GetProgramBinary || !gl_.ProgramBinary || !gl_.ProgramParameteri) return;
  Int count = 0;
  gl_.GetIntegerv(NUM_PROGRAM_BINARY_FORMATS, &count);
  formats_.resize(static_cast<std::size_t>(std::max(count, 0)));
  if (formats_.empty()) return;
  gl_.GetIntegerv(PROGRAM_BINARY_FORMATS, formats_.data());
  for (const Enum name : {VENDOR, RENDERER, VERSION})
    if (const auto* text = gl_.GetString(name)) driver_ += reinterpret_cast<const char*>(text) + std::string("\n");
  for (const Int format : formats_)
    driver_ += std::to_string(format) + " ";
}

bool ProgramBinaries::areKept() {
  if (!asked_) askDriver();
  return !formats_.empty();
}

std::string ProgramBinaries::keyOf(const std::vector<std::string>& texts) const {
  Hash hash;
  hash.add(driver_);
  for (const std::string& text : texts)
    hash.add(text);
  return hash.hex();
}

Bytes ProgramBinaries::loadBytes(const std::string& key) const {
  try {
    return store_.load(key);
  } catch (...) {
    return {};
  }
}

bool ProgramBinaries::load(Uint program, const std::string& key) const {
  const Bytes bytes = loadBytes(key);
  Header header;
  if (bytes.size() <= sizeof(header)) return false;
  std::memcpy(&header, bytes.data(), sizeof(header));
  const std::uint8_t* const binary = bytes.data() + sizeof(header);
  const std::size_t size = bytes.size() - sizeof(header);
  if (header.magic != kMagic || header.length != size || header.checksum != checksumOf(key, binary, size)) return false;
  const bool known = std::find(formats_.begin(), formats_.end(), static_cast<Int>(header.format)) != formats_.end();
  if (!known || size > static_cast<std::size_t>(std::numeric_limits<Sizei>::max())) return false;
  gl_.ProgramBinary(program, header.format, binary, static_cast<Sizei>(size));
  return true;
}

void ProgramBinaries::save(Uint program, const std::string& key) const {
  Int size = 0;
  gl_.GetProgramiv(program, PROGRAM_BINARY_LENGTH, &size);
  if (size <= 0) return;
  Header header;
  Bytes bytes(sizeof(header) + static_cast<std::size_t>(size));
  std::uint8_t* const binary = bytes.data() + sizeof(header);
  Sizei written = 0;
  gl_.GetProgramBinary(program, size, &written, &header.format, binary);
  if (written <= 0 || written > size) return;
  bytes.resize(sizeof(header) + static_cast<std::size_t>(written));
  header.length = static_cast<std::uint64_t>(written);
  header.checksum = checksumOf(key, binary, header.length);
  std::memcpy(bytes.data(), &header, sizeof(header));
  try {
    store_.save(key, bytes);
  } catch (...) { // not kept, then
  }
}

} // namespace tyndall::gl
