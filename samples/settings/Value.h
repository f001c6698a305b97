// What a setting holds, whatever its type.
#pragma once

#include <array>
#include <string>

namespace settings {

/// Up to three numbers: a switch is 0 or 1, a choice the number of its enumerator; none where nothing is set.
struct Value {
  std::array<double, 3> numbers{};
  int count = 1;

  Value() = default;
  Value(double number) : numbers{number} {}
  Value(double x, double y, double z) : numbers{x, y, z}, count(3) {}
  static Value none() {
    Value value;
    value.count = 0;
    return value;
  }

  double operator[](int i) const { return numbers[static_cast<std::size_t>(i)]; }
};

inline bool operator==(const Value& a, const Value& b) {
  if (a.count != b.count) return false;
  for (int i = 0; i < a.count; ++i)
    if (a[i] != b[i]) return false;
  return true;
}
inline bool operator!=(const Value& a, const Value& b) { return !(a == b); }

/// The shortest decimal that stands for the number, as a float or as a double; "infinity".
std::string textOf(double number, bool isFloat);

/// The double that is written like the float: 0.04 for 0.04F.
double decimalOf(float number);

} // namespace settings
