// JSON from files and command lines: bounded, so that neither what reads it nor what shows it in a message runs out of
// stack or memory.
#pragma once

#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <string>
#include <string_view>

namespace host {

inline constexpr std::size_t kMaxJsonValues = 4'000'000; ///< numbers, texts, arrays and objects
inline constexpr int kMaxJsonDepth = 64;                 ///< nested arrays and objects

/// Which bound the text exceeds, as "nested deeper than ..."; empty if none. Syntax errors are left to the parser.
std::string excessOfJson(std::string_view text, bool mayHaveComments = false);

/// Json: nlohmann::json or ordered_json. Throws Error, which says what is wrong and not where.
template <typename Json>
Json parseJson(std::string_view text, bool mayHaveComments = false) {
  if (const std::string excess = excessOfJson(text, mayHaveComments); !excess.empty()) throw Error(excess);
  try {
    return Json::parse(text.begin(), text.end(), nullptr, true, mayHaveComments);
  } catch (const typename Json::exception& error) {
    throw Error(printable(error.what()));
  }
}

/// The bytes of a file as text.
inline std::string_view textOf(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace host
