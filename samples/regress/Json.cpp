#include "Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Json.h>

namespace regress {

Json readJson(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = 16U << 20;
  const std::vector<std::uint8_t> bytes = host::readFile(file, kMaxBytes);
  try {
    return host::parseJson<Json>(host::textOf(bytes), true);
  } catch (const host::Error& error) {
    throw host::Error(fmt::format("{}: is no JSON: {}", host::printable(file.string()), error.what()));
  }
}

void writeJson(const std::filesystem::path& file, const Json& json) {
  // A driver's name may hold any bytes.
  host::writeText(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string textOf(const Json& json, const std::string& where) {
  if (!json.is_string()) throw host::Error(where + ": must be a text");
  auto text = json.get<std::string>();
  if (text.find('\0') != std::string::npos) throw host::Error(where + ": must hold no zero byte");
  return text;
}

void requireFields(const Json& json, std::initializer_list<const char*> known, const std::string& where) {
  if (!json.is_object()) throw host::Error(where + ": must be an object");
  for (const auto& [name, value] : json.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw host::Error(
          fmt::format("{}: \"{}\" is unknown; known are {}", where, host::printable(name), fmt::join(known, ", ")));
}

void requireFormat(const Json& json, const std::string& where) {
  if (json.is_object() && json.contains("format") && json.at("format") == kFormat) return;
  const std::string found = json.is_object() && json.contains("format") ? json.at("format").dump() : "none";
  throw host::Error(fmt::format("{}: is of format {}, this tool reads {}", where, host::printable(found), kFormat));
}

} // namespace regress
