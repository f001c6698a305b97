#include "RowJson.h"

#include <cmath>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace settings {

namespace {

constexpr const char *kInfinityText = "infinity", *kMinusInfinityText = "-infinity";

Json numberJson(const Row& row, double number) {
  if (std::isinf(number)) return number > 0 ? kInfinityText : kMinusInfinityText;
  if (row.type == Type::Whole) return static_cast<std::int64_t>(number);
  return number;
}

Value choiceOf(const Row& row, const Json& value) {
  for (const Choice& choice : row.choices)
    if (value == choice.name) return static_cast<double>(choice.value);
  return Value::none();
}

double numberOf(const Json& value) {
  if (value == kInfinityText) return std::numeric_limits<double>::infinity();
  if (value == kMinusInfinityText) return -std::numeric_limits<double>::infinity();
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// None for what is of another type.
Value read(const Row& row, const Json& value) {
  if (row.type == Type::Switch) return value.is_boolean() ? Value(value.get<bool>()) : Value::none();
  if (row.type == Type::Choice) return choiceOf(row, value);
  if (row.count() == 1) return numberOf(value);
  if (!value.is_array() || value.size() != 3) return Value::none();
  return {numberOf(value[0]), numberOf(value[1]), numberOf(value[2])};
}

} // namespace

void refuse(const std::string& where, const std::string& rule) {
  throw host::Error(where + ": " + host::printable(rule));
}

std::string shown(const Json& value) { return value.dump(-1, ' ', true, Json::error_handler_t::replace); }

void requireObject(const Json& value, const std::string& where) {
  if (!value.is_object()) refuse(where, "must be an object");
}

Json jsonOf(const Row& row, const Value& value) {
  if (value.count == 0) return nullptr;
  if (row.type == Type::Switch) return value[0] != 0;
  if (row.type == Type::Choice) return textOf(row, value);
  if (value.count == 1) return numberJson(row, value[0]);
  return Json::array({numberJson(row, value[0]), numberJson(row, value[1]), numberJson(row, value[2])});
}

Value valueOf(const Row& row, const Json& json, const std::string& where) {
  if (json.is_null() && row.rule.mayBeUnset) return Value::none();
  const std::string rule = row.type == Type::Switch ? "must be true or false" : "must be " + ruleOf(row);
  const Value value = read(row, json);
  if (value.count == 0 || !breachOf(row, value).empty()) refuse(where, shown(json) + " " + rule);
  return value;
}

} // namespace settings
