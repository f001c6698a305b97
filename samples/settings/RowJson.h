// Structs as JSON objects by their tables.
#pragma once

#include "Row.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace settings {

using Json = nlohmann::ordered_json;

/// Throws host::Error: "WHERE: RULE".
[[noreturn]] void refuse(const std::string& where, const std::string& rule);
/// A value as an error names it.
std::string shown(const Json& value);
void requireObject(const Json& value, const std::string& where);

Json jsonOf(const Row& row, const Value& value);
/// Throws host::Error where it is no value of the row.
Value valueOf(const Row& row, const Json& value, const std::string& where);

template <typename Owner>
Json jsonOf(const Table<Owner>& table, const Owner& owner) {
  Json object = Json::object();
  for (const Setting<Owner>& row : table.rows) {
    Json* place = &object;
    std::string name = row.field;
    if (const std::size_t dot = name.find('.'); dot != std::string::npos) {
      place = &object[name.substr(0, dot)];
      name = name.substr(dot + 1);
    }
    (*place)[name] = jsonOf(row, row.get(owner));
  }
  return object;
}

/// Fields that are not in the object stay; one that is no row throws host::Error, but for `others`, which the caller
/// reads.
template <typename Owner>
void readInto(const Table<Owner>& table, Owner& owner, const Json& object, const std::string& where,
              const std::vector<std::string>& others = {}, const std::string& prefix = {}) {
  requireObject(object, where);
  for (const auto& [name, value] : object.items()) {
    const std::string field = prefix + name, inner = field + ".", place = fmt::format("{}.{}", where, name);
    if (std::find(others.begin(), others.end(), field) != others.end()) continue;
    bool isRow = false, isPart = false;
    for (const Setting<Owner>& row : table.rows) {
      isPart = isPart || row.field.rfind(inner, 0) == 0;
      if (row.field != field) continue;
      isRow = true;
      row.set(owner, valueOf(row, value, place));
    }
    if (isPart) readInto(table, owner, value, place, {}, inner);
    if (!isRow && !isPart) refuse(where, "has no field " + shown(name));
  }
}

} // namespace settings
