// The words of a check's message: the field, its value and the rule, in one line.
#pragma once

#include <cstdio>
#include <string>
#include <tyndall/tyndall.h>

namespace tyndall {

/// A number as messages have it.
inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

template <typename Vector>
std::string textOf(const Vector& v) {
  return "(" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + ")";
}

inline std::string textOf(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

inline std::string textOf(const Rectangle& r) {
  return textOf(r.width, r.height) + " at (" + std::to_string(r.x) + ", " + std::to_string(r.y) + ")";
}

/// "Frame::lights[0].range is -1: must be > 0"; without a value "Frame::field: the rule".
inline std::string lineOf(const std::string& field, const std::string& value, const std::string& rule) {
  return "Frame::" + field + (value.empty() ? "" : " is " + value) + ": " + rule;
}

inline Status invalid(const std::string& field, const std::string& value, const std::string& rule) {
  return {StatusCode::InvalidFrame, lineOf(field, value, rule)};
}

} // namespace tyndall
