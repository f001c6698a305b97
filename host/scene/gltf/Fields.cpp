#include "Fields.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace host::gltf {

namespace {

/// Rewrites a float without fraction as an integer, as glTF allows whole numbers to be written either way.
void makeInteger(nlohmann::json& value) {
  constexpr double kExact = 9007199254740992.0; // 2^53: whole doubles up to here are exact
  if (!value.is_number_float()) return;
  const double number = value.get<double>();
  if (std::abs(number) <= kExact && number == std::floor(number)) value = static_cast<std::int64_t>(number);
}

/// A JSON integer, or nothing if the value is none or needs more than 63 bits.
std::optional<std::int64_t> toInteger(nlohmann::json& value) {
  makeInteger(value);
  if (!value.is_number_integer()) return std::nullopt;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) {
    return std::nullopt;
  }
  return value.get<std::int64_t>();
}

std::string indexRule(const char* collection, std::size_t count) {
  return std::string("must be an index into ") + collection + ", which has " + std::to_string(count);
}

} // namespace

Fields::Fields(Document& document, nlohmann::json& object, std::string path)
    : document_(document), object_(object), path_(std::move(path)) {
  if (!object_.is_object()) document_.refuse(path_, "must be an object");
}

nlohmann::json* Fields::find(const char* key, Need need) const {
  const auto found = object_.find(key);
  if (found != object_.end()) return &*found;
  if (need == Need::Required) refuse(key, "is missing");
  return nullptr;
}

std::optional<std::int64_t> Fields::integer(const char* key, std::int64_t low, std::int64_t high, Need need) {
  nlohmann::json* value = find(key, need);
  if (value == nullptr) return std::nullopt;
  const std::optional<std::int64_t> number = toInteger(*value);
  if (!number || *number < low || *number > high) {
    refuse(key, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return number;
}

std::optional<std::int64_t> Fields::index(const char* key, const char* collection, Need need) {
  nlohmann::json* value = find(key, need);
  if (value == nullptr) return std::nullopt;
  const std::size_t count = document_.count(collection);
  const std::optional<std::int64_t> number = toInteger(*value);
  if (!number || *number < 0 || static_cast<std::size_t>(*number) >= count) refuse(key, indexRule(collection, count));
  return number;
}

void Fields::indices(const char* key, const char* collection) {
  nlohmann::json* list = array(key);
  if (list == nullptr) return;
  const std::size_t count = document_.count(collection);
  std::set<std::int64_t> seen;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::optional<std::int64_t> number = toInteger((*list)[i]);
    if (!number || *number < 0 || static_cast<std::size_t>(*number) >= count) {
      document_.refuse(at(path(key), i), indexRule(collection, count));
    }
    if (!seen.insert(*number).second) document_.refuse(at(path(key), i), "must not repeat an earlier one");
  }
}

std::int64_t Fields::requiredInteger(const char* key, std::int64_t low, std::int64_t high) {
  return integer(key, low, high, Need::Required).value_or(low); // which refuses to lack one
}

std::int64_t Fields::requiredIndex(const char* key, const char* collection) {
  return index(key, collection, Need::Required).value_or(0);
}

std::optional<double> Fields::number(const char* key, Need need) {
  nlohmann::json* value = find(key, need);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) refuse(key, "must be a number");
  return value->get<double>();
}

void Fields::numbers(const char* key, std::size_t length) {
  nlohmann::json* list = array(key);
  if (list == nullptr) return;
  const bool allNumbers = std::all_of(list->begin(), list->end(), [](const auto& value) { return value.is_number(); });
  if (list->size() != length || !allNumbers) refuse(key, "must be " + std::to_string(length) + " numbers");
}

void Fields::boolean(const char* key) {
  nlohmann::json* value = find(key, Need::Optional);
  if (value != nullptr && !value->is_boolean()) refuse(key, "must be true or false");
}

std::string Fields::string(const char* key, Need need, std::initializer_list<const char*> allowed) {
  nlohmann::json* value = find(key, need);
  if (value == nullptr) return {};
  if (!value->is_string()) refuse(key, "must be a string");
  const auto& text = value->get_ref<const std::string&>();
  if (allowed.size() > 0 && std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
    std::string list;
    for (const char* word : allowed)
      list += (list.empty() ? "" : ", ") + std::string(word);
    refuse(key, "\"" + text + "\" must be one of " + list);
  }
  return text;
}

nlohmann::json* Fields::object(const char* key, Need need) {
  nlohmann::json* value = find(key, need);
  if (value != nullptr && !value->is_object()) refuse(key, "must be an object");
  return value;
}

nlohmann::json* Fields::array(const char* key, Need need) {
  nlohmann::json* value = find(key, need);
  if (value != nullptr && !value->is_array()) refuse(key, "must be an array");
  return value;
}

} // namespace host::gltf
