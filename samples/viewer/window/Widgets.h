// Settings as Dear ImGui's widgets, whatever their table.
#pragma once

#include <cstdint>
#include <glad/gl.h>
#include <imgui.h>
#include <settings/Tables.h>

namespace viewer {

/// A texture as Dear ImGui takes it: a pointer in old versions, a number in new ones.
ImTextureID imageOf(GLuint texture);

/// A setting's name, as in the header, and its value; a tooltip has help, range and default, a right click resets it.
/// Whether the value is another one, which keeps the rule.
bool editValue(const settings::Row& row, settings::Value& value, const settings::Value& start);

/// Help of what was drawn last, under the mouse.
void tooltip(const std::string& text);

/// A heading with "reset" at its right; whether that was pressed.
bool heading(const char* name, bool isAtStart);

bool isAmong(const std::vector<std::string>& fields, const std::string& field);

/// All rows of a table but those of `hidden`. Whether one was changed: `edited` is its field.
template <typename Owner>
bool editRows(const settings::Table<Owner>& table, Owner& owner, const Owner& start, std::string& edited,
              const std::vector<std::string>& hidden = {}) {
  bool isEdited = false;
  for (const settings::Setting<Owner>& row : table.rows) {
    if (isAmong(hidden, row.field)) continue;
    settings::Value value = row.get(owner);
    if (!editValue(row, value, row.get(start))) continue;
    row.set(owner, value);
    edited = row.field;
    isEdited = true;
  }
  return isEdited;
}

/// Whether all rows but those are as in `start`.
template <typename Owner>
bool isAtStart(const settings::Table<Owner>& table, const Owner& owner, const Owner& start,
               const std::vector<std::string>& hidden = {}) {
  for (const settings::Setting<Owner>& row : table.rows)
    if (row.get(owner) != row.get(start) && !isAmong(hidden, row.field)) return false;
  return true;
}

} // namespace viewer
