#include "Widgets.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

using settings::Row;
using settings::Type;
using settings::Value;

constexpr float kLabelShare = 0.42F; ///< of a panel's width

void label(const Row& row, bool isAtStart) {
  ImGui::AlignTextToFramePadding();
  if (isAtStart)
    ImGui::TextUnformatted(row.field.c_str());
  else
    ImGui::TextColored(ImVec4(1.0F, 0.8F, 0.4F, 1.0F), "%s", row.field.c_str());
}

bool editChoice(const Row& row, Value& value) {
  const std::string now = textOf(row, value);
  bool isChanged = false;
  if (!ImGui::BeginCombo("##value", now.c_str())) return false;
  for (const settings::Choice& choice : row.choices)
    if (ImGui::Selectable(choice.name, choice.value == value[0])) {
      value = static_cast<double>(choice.value);
      isChanged = true;
    }
  ImGui::EndCombo();
  return isChanged;
}

/// Numbers of which only some are allowed.
bool editOneOf(const Row& row, Value& value) {
  bool isChanged = false;
  if (!ImGui::BeginCombo("##value", textOf(row, value).c_str())) return false;
  for (const double number : row.rule.only)
    if (ImGui::Selectable(settings::textOf(number, row.isFloat).c_str(), number == value[0])) {
      value = number;
      isChanged = true;
    }
  ImGui::EndCombo();
  return isChanged;
}

struct Ends {
  double low, high;
};

Ends endsOf(const Row& row) {
  if (row.slider.low != 0 || row.slider.high != 0) return {row.slider.low, row.slider.high};
  return {row.rule.low, row.rule.high};
}

bool isBounded(const Ends& ends) { return ends.high - ends.low < 1e6; }

bool editNumber(const Row& row, Value& value) {
  const Ends ends = endsOf(row);
  const bool isLogarithmic = row.slider.isLogarithmic;
  const char* const format = row.type == Type::Whole ? "%.0f" : isLogarithmic ? "%.4g" : "%.3f";
  double number = value[0];
  const ImGuiSliderFlags flags = isLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  bool isChanged = false;
  if (isBounded(ends)) {
    isChanged = ImGui::SliderScalar("##value", ImGuiDataType_Double, &number, &ends.low, &ends.high, format, flags);
  } else {
    const float speed = static_cast<float>(std::max(std::abs(number) * 0.01, 0.01));
    isChanged = ImGui::DragScalar("##value", ImGuiDataType_Double, &number, speed, nullptr, nullptr, "%.4g");
  }
  if (!isChanged) return false;
  if (row.type == Type::Whole) number = std::round(number / row.rule.multipleOf) * row.rule.multipleOf;
  number = std::clamp(number, row.rule.low, row.rule.high); // one that was typed
  value = number;
  return true;
}

/// What stands outside of the range: infinity, 0 or a value left to the tool.
bool editBesides(const Row& row, Value& value, const Value& start) {
  const bool mayBeUnset = row.rule.mayBeUnset;
  if (!mayBeUnset && row.rule.also.empty()) return false;
  const Value besides = mayBeUnset ? Value::none() : Value(row.rule.also.front());
  const bool isAuto = mayBeUnset || row.rule.also.front() < 0;
  const std::string name = isAuto ? "auto" : settings::textOf(row.rule.also.front(), row.isFloat);
  bool isBesides = value == besides;
  const bool isChanged = ImGui::Checkbox(name.c_str(), &isBesides);
  if (!isChanged) return false;
  const Ends ends = endsOf(row);
  const double first = isBounded(ends) && row.slider.isLogarithmic ? std::sqrt(ends.low * ends.high)
                       : isBounded(ends)                           ? 0.5 * (ends.low + ends.high)
                                                                   : 100;
  value = isBesides ? besides : start == besides ? Value(row.type == Type::Whole ? std::round(first) : first) : start;
  return true;
}

bool editThree(const Row& row, Value& value) {
  const double size = std::max({std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
  const bool isColour = row.type == Type::Colour;
  if (isColour) ImGui::SetNextItemWidth(-ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x);
  const double least = row.rule.low, most = row.rule.high;
  const bool isChanged = ImGui::DragScalarN("##value", ImGuiDataType_Double, value.numbers.data(), 3,
                                            static_cast<float>(0.01 * std::max(size, 0.01)),
                                            isColour ? &least : nullptr, isColour ? &most : nullptr, "%.3g");
  if (!isColour) return isChanged;
  const double scale = size > 0 ? 1 / size : 0;
  const ImVec4 hue(static_cast<float>(scale * std::abs(value[0])), static_cast<float>(scale * std::abs(value[1])),
                   static_cast<float>(scale * std::abs(value[2])), 1);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::ColorButton("##hue", hue, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop);
  return isChanged;
}

bool editAny(const Row& row, Value& value, const Value& start) {
  if (row.type == Type::Switch) {
    bool isOn = value[0] != 0;
    const bool isChanged = ImGui::Checkbox("##value", &isOn);
    value = isOn ? 1.0 : 0.0;
    return isChanged;
  }
  if (row.type == Type::Choice) return editChoice(row, value);
  if (row.count() == 3) return editThree(row, value);
  if (!row.rule.only.empty()) return editOneOf(row, value);
  if (editBesides(row, value, start)) return true;
  const bool isBesides = value.count == 0 || (!row.rule.also.empty() && value[0] == row.rule.also.front());
  if (isBesides) return false;
  if (row.rule.mayBeUnset || !row.rule.also.empty()) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
  }
  return editNumber(row, value);
}

} // namespace

bool isAmong(const std::vector<std::string>& fields, const std::string& field) {
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

// NOLINTNEXTLINE(performance-no-int-to-ptr): which type it is depends on Dear ImGui's version
ImTextureID imageOf(GLuint texture) { return (ImTextureID)(std::intptr_t)texture; }

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool heading(const char* name, bool isAtStart) {
  ImGui::PushID(name);
  ImGui::Separator();
  ImGui::TextUnformatted(name);
  const char* const reset = "reset";
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(reset).x -
                  2 * ImGui::GetStyle().FramePadding.x);
  ImGui::BeginDisabled(isAtStart);
  const bool isPressed = ImGui::SmallButton(reset);
  ImGui::EndDisabled();
  ImGui::PopID();
  return isPressed;
}

bool editValue(const Row& row, Value& value, const Value& start) {
  ImGui::PushID(row.field.c_str());
  const float left = ImGui::GetCursorPosX(), width = ImGui::GetContentRegionAvail().x;
  ImGui::BeginGroup();
  label(row, value == start);
  ImGui::SameLine(left + kLabelShare * width);
  ImGui::SetNextItemWidth(-1);
  Value edited = value;
  bool isChanged = editAny(row, edited, start);
  ImGui::EndGroup();
  const std::string unit = row.unit.empty() ? "" : " [" + row.unit + "]";
  tooltip(row.field + unit + ": " + row.help + ". " + ruleOf(row) + "; default " + textOf(row, start) +
          " (right click)");
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right) && value != start) {
    edited = start;
    isChanged = true;
  }
  ImGui::PopID();
  if (!isChanged || !breachOf(row, edited).empty()) return false;
  value = edited;
  return true;
}

} // namespace viewer
