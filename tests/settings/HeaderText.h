// What structs and enumerations a header declares, read from its text.
#pragma once

#include <string>
#include <vector>

namespace tests {

/// The names between the braces of `struct NAME {` or `enum class NAME {`: fields, or enumerators. Empty where the
/// header has no such type.
std::vector<std::string> fieldsOf(const std::string& header, const std::string& name);
std::vector<std::string> enumeratorsOf(const std::string& header, const std::string& name);

/// Of Settings, Light and all else that a person sets a field of: "Struct.field" for those that no table has and that
/// are not said to be the engine's; and what tables have or say that the header has not.
std::vector<std::string> unknownFields(const std::string& header);

} // namespace tests
