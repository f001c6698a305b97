// JSON files, judged: whatever is wrong with one is a line with its name.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

namespace regress {

using Json = nlohmann::ordered_json;

/// Of lists, sidecars and results. Others are refused.
inline constexpr int kFormat = 1;

/// Throws host::Error, as all of these.
Json readJson(const std::filesystem::path& file);
void writeJson(const std::filesystem::path& file, const Json& json);

/// `where` begins the message.
std::string textOf(const Json& json, const std::string& where);
void requireFields(const Json& json, std::initializer_list<const char*> known, const std::string& where);
void requireFormat(const Json& json, const std::string& where);

} // namespace regress
