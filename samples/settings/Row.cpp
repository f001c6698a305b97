#include "Row.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace settings {

namespace {

const Choice* find(const Row& row, double value) {
  const auto found = std::find_if(row.choices.begin(), row.choices.end(),
                                  [value](const Choice& choice) { return choice.value == value; });
  return found == row.choices.end() ? nullptr : &*found;
}

std::string listOf(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers)
    list += (list.empty() ? "" : ", ") + textOf(number, false);
  return list;
}

std::string namesOf(const Row& row) {
  std::string names;
  for (const Choice& choice : row.choices)
    names += (names.empty() ? "" : ", ") + std::string(choice.name);
  return names;
}

} // namespace

std::string textOf(double number, bool isFloat) {
  if (std::isinf(number)) return number > 0 ? "infinity" : "-infinity";
  return isFloat ? fmt::format("{}", static_cast<float>(number)) : fmt::format("{}", number);
}

double decimalOf(float number) {
  return std::isfinite(number) ? std::strtod(fmt::format("{}", number).c_str(), nullptr) : number;
}

bool Rule::holds(double number) const {
  if (std::find(also.begin(), also.end(), number) != also.end()) return true;
  if (!only.empty()) return std::find(only.begin(), only.end(), number) != only.end();
  if (!std::isfinite(number)) return false;
  const bool isAbove = isLowOpen ? number > low : number >= low;
  const bool isBelow = isHighOpen ? number < high : number <= high;
  return isAbove && isBelow && (multipleOf == 1 || std::fmod(number, multipleOf) == 0);
}

std::string rangeOf(const Rule& rule) {
  const bool hasLow = std::isfinite(rule.low) && rule.low > -std::numeric_limits<float>::max();
  const bool hasHigh = std::isfinite(rule.high) && rule.high < std::numeric_limits<float>::max();
  const std::string low = textOf(rule.low, false), high = textOf(rule.high, false);
  if (hasLow && hasHigh && rule.isLowOpen && rule.isHighOpen) return " between " + low + " and " + high;
  if (hasLow && hasHigh && rule.isLowOpen) return " above " + low + ", at most " + high;
  if (hasLow && hasHigh) return " from " + low + " to " + high;
  if (hasLow) return rule.isLowOpen ? " above " + low : " of at least " + low;
  return "";
}

std::string ruleOf(const Row& row) {
  if (row.type == Type::Switch) return "on or off";
  if (row.type == Type::Choice) return "one of " + namesOf(row);
  if (!row.rule.only.empty()) return "one of " + listOf(row.rule.only);
  std::string text = row.count() == 3          ? "three finite numbers"
                     : row.type == Type::Whole ? "a whole number"
                                               : "a number";
  const bool isRadiance = row.count() == 3 && row.rule.low == 0 && row.rule.high > 1e30; // its end is that of floats
  text += isRadiance ? ", none negative" : rangeOf(row.rule);
  if (row.type == Type::Direction) text += ", not all 0";
  if (row.rule.multipleOf != 1) text += fmt::format(", a multiple of {}", row.rule.multipleOf);
  if (!row.rule.also.empty()) text += ", or " + listOf(row.rule.also);
  return text;
}

std::string breachOf(const Row& row, const Value& value) {
  const auto must = [&row] { return "must be " + ruleOf(row); };
  if (value.count == 0 && row.rule.mayBeUnset) return {};
  if (value.count != row.count()) return must();
  bool isZero = true;
  for (int i = 0; i < value.count; ++i) {
    const double number = row.isFloat ? static_cast<double>(static_cast<float>(value[i])) : value[i];
    // A float next to an end of the range rounds onto it, or beyond what floats hold.
    const bool holds =
        row.rule.holds(value[i]) && row.rule.holds(row.isFloat ? decimalOf(static_cast<float>(number)) : number);
    const bool isWhole = row.type != Type::Whole || value[i] == std::floor(value[i]);
    if (!holds || !isWhole) return must();
    isZero = isZero && number == 0;
  }
  if (row.type == Type::Direction && isZero) return must();
  return {};
}

std::string textOf(const Row& row, const Value& value) {
  if (value.count == 0) return "auto";
  if (row.type == Type::Switch) return value[0] != 0 ? "on" : "off";
  if (row.type == Type::Choice) {
    const Choice* choice = find(row, value[0]);
    return choice ? choice->name : "?";
  }
  std::string text = textOf(value[0], row.isFloat);
  for (int i = 1; i < value.count; ++i)
    text += "," + textOf(value[i], row.isFloat);
  return text;
}

} // namespace settings
