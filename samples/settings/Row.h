// A setting that a person may set: its name in the header, its type, range and help, and how it is read and written.
#pragma once

#include "Value.h"

#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace settings {

enum class Type {
  Switch,
  Whole,
  Number,
  Choice,
  Colour,    ///< three numbers, linear RGB
  Place,     ///< three numbers, world space
  Direction, ///< the same, any length but 0
};

/// What numbers are allowed.
struct Rule {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool isLowOpen = false; ///< low itself is not allowed
  bool isHighOpen = false;
  int multipleOf = 1;       ///< of whole numbers
  std::vector<double> only; ///< if any: nothing else is allowed
  std::vector<double> also; ///< allowed outside the range, too; infinity is by this list only
  bool mayBeUnset = false;  ///< Value::none()
  bool holds(double number) const;
};

/// From low to high.
inline Rule from(double low, double high) {
  Rule rule;
  rule.low = low;
  rule.high = high;
  return rule;
}
/// The same without low itself.
inline Rule above(double low, double high = std::numeric_limits<double>::max()) {
  Rule rule = from(low, high);
  rule.isLowOpen = true;
  return rule;
}
/// The same without both.
inline Rule between(double low, double high) {
  Rule rule = above(low, high);
  rule.isHighOpen = true;
  return rule;
}
inline Rule only(std::vector<double> numbers) {
  Rule rule = from(numbers.front(), numbers.back());
  rule.only = std::move(numbers);
  return rule;
}
/// The rule with a number that is allowed outside of it.
inline Rule also(double number, Rule rule) {
  rule.also.push_back(number);
  return rule;
}

struct Choice {
  const char* name;       ///< on command lines and in files
  const char* enumerator; ///< in the header
  int value;
};

/// How a command line gives it.
enum class OptionForm {
  Value,
  FlagOn,  ///< a flag that switches it on
  FlagOff, ///< one that switches it off
};

/// What a slider shows of the range.
struct Slider {
  double low = 0;
  double high = 0; ///< both 0: the range
  bool isLogarithmic = false;
};

/// All of a setting but the accessors.
struct Row {
  std::string field; ///< in the header
  std::string help;  ///< one line
  Type type = Type::Number;
  Rule rule;
  bool isFloat = false;        ///< stored as one
  std::string enumeration;     ///< of a choice: the type's name
  std::vector<Choice> choices; ///< its enumerators that may be chosen
  std::string option;          ///< of the command line; empty: none
  OptionForm form = OptionForm::Value;
  std::string optionHelp; ///< what a command line says of it, if not help and default
  Slider slider;
  std::string unit; ///< of the numbers, for people

  int count() const { return type == Type::Colour || type == Type::Place || type == Type::Direction ? 3 : 1; }
};

/// What the value breaks, as the end of a sentence: "must be ..."; empty if nothing.
std::string breachOf(const Row& row, const Value& value);
/// The rule: "a whole number from 1 to 8192".
std::string ruleOf(const Row& row);
/// Its range: " from 1 to 8192"; empty if there is none.
std::string rangeOf(const Rule& rule);
/// As command lines have it: "0.04", "epipolar", "on", "1,2,3".
std::string textOf(const Row& row, const Value& value);

template <typename Owner>
struct Setting : Row {
  std::function<Value(const Owner&)> get;
  std::function<void(Owner&, const Value&)> set; ///< of what breaks no rule

  Setting&& withOption(std::string name, OptionForm how = OptionForm::Value, std::string says = {}) && {
    option = std::move(name);
    form = how;
    optionHelp = std::move(says);
    return std::move(*this);
  }
  Setting&& withSlider(double low, double high, bool isLogarithmic = false) && {
    slider = {low, high, isLogarithmic};
    return std::move(*this);
  }
  Setting&& in(std::string what) && {
    unit = std::move(what);
    return std::move(*this);
  }
};

/// All settings of a struct.
template <typename Owner>
struct Table {
  std::string owner; ///< its name
  std::vector<Setting<Owner>> rows;

  /// The row of a field that is known to have one.
  const Setting<Owner>& operator[](const std::string& field) const {
    for (const Setting<Owner>& row : rows)
      if (row.field == field) return row;
    throw std::logic_error(owner + "." + field + " is no setting");
  }
};

namespace detail {

template <typename Number>
Value valueOf(const Number& number) {
  if constexpr (std::is_same_v<Number, float>)
    return decimalOf(number);
  else
    return static_cast<double>(number);
}

/// A row without type and rule.
template <typename Owner, typename Member>
Setting<Owner> scalar(const char* field, Member Owner::* member, const char* help) {
  Setting<Owner> setting;
  setting.field = field;
  setting.help = help;
  setting.isFloat = std::is_same_v<Member, float>;
  setting.get = [member](const Owner& owner) { return valueOf(owner.*member); };
  setting.set = [member](Owner& owner, const Value& value) { owner.*member = static_cast<Member>(value[0]); };
  return setting;
}

} // namespace detail

template <typename Owner>
Setting<Owner> switchOf(const char* field, bool Owner::* member, const char* help) {
  Setting<Owner> setting = detail::scalar(field, member, help);
  setting.set = [member](Owner& owner, const Value& value) { owner.*member = value[0] != 0; };
  setting.type = Type::Switch;
  setting.rule = from(0, 1);
  return setting;
}

/// int, unsigned integers, float or double.
template <typename Owner, typename Member>
Setting<Owner> number(const char* field, Member Owner::* member, Rule rule, const char* help) {
  Setting<Owner> setting = detail::scalar(field, member, help);
  setting.type = std::is_integral_v<Member> ? Type::Whole : Type::Number;
  setting.rule = std::move(rule);
  return setting;
}

/// One that may be left unset.
template <typename Owner>
Setting<Owner> number(const char* field, std::optional<double> Owner::* member, Rule rule, const char* help) {
  Setting<Owner> setting;
  setting.field = field;
  setting.help = help;
  setting.rule = std::move(rule);
  setting.rule.mayBeUnset = true;
  setting.get = [member](const Owner& owner) { return owner.*member ? Value(*(owner.*member)) : Value::none(); };
  setting.set = [member](Owner& owner, const Value& value) {
    owner.*member = value.count == 0 ? std::nullopt : std::optional<double>(value[0]);
  };
  return setting;
}

template <typename Owner, typename Enum>
Setting<Owner> choice(const char* field, Enum Owner::* member, const char* enumeration, std::vector<Choice> choices,
                      const char* help) {
  Setting<Owner> setting = detail::scalar(field, member, help);
  setting.get = [member](const Owner& owner) { return static_cast<double>(owner.*member); };
  setting.set = [member](Owner& owner, const Value& value) {
    owner.*member = static_cast<Enum>(static_cast<int>(value[0]));
  };
  setting.type = Type::Choice;
  setting.enumeration = enumeration;
  for (const Choice& one : choices)
    setting.rule.only.push_back(one.value);
  setting.choices = std::move(choices);
  return setting;
}

/// An array of three, or a glm vector.
template <typename Owner, typename Vector>
Setting<Owner> vector(const char* field, Vector Owner::* member, Type type, Rule rule, const char* help) {
  using Element = std::decay_t<decltype(std::declval<Vector>()[0])>;
  Setting<Owner> setting;
  setting.field = field;
  setting.help = help;
  setting.type = type;
  setting.rule = std::move(rule);
  setting.isFloat = std::is_same_v<Element, float>;
  setting.get = [member](const Owner& owner) {
    const Vector& v = owner.*member;
    return Value(detail::valueOf(v[0])[0], detail::valueOf(v[1])[0], detail::valueOf(v[2])[0]);
  };
  setting.set = [member](Owner& owner, const Value& value) {
    for (int i = 0; i < 3; ++i)
      (owner.*member)[i] = static_cast<Element>(value[i]);
  };
  return setting;
}

/// The row of a struct that the owner holds, as a row of the owner: "boundary.normal".
template <typename Owner, typename Part>
Setting<Owner> part(const char* field, Part Owner::* member, const Setting<Part>& inner) {
  Setting<Owner> setting;
  static_cast<Row&>(setting) = inner;
  setting.field = std::string(field) + "." + inner.field;
  setting.get = [member, get = inner.get](const Owner& owner) { return get(owner.*member); };
  setting.set = [member, set = inner.set](Owner& owner, const Value& value) { set(owner.*member, value); };
  return setting;
}

} // namespace settings
