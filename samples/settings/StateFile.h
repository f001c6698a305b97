// States as JSON:
// {"version": 1, "scene": "nave.glb", "camera": {"scene": 0}, "picture": {...}, "maps": {...}, "profile": "high",
//  "settings": {...}, "reuse": {...}, "tuning": {...}, "medium": {...}, "ambient": {...}, "fog": {..., "banks": [{...},
//  ...]}, "lights": [{...}, ...]}
// A camera of one's own is {"eye": [x, y, z], "target": [x, y, z], "fovDegrees": 50}. Fields are those of the tables
// (Tables.h), by their names there; what is left out is at its default, settings at those of the profile, medium,
// ambient light, fog and lights are the scene's; what a fog leaves out is as scenes' fog begins, but banks, which are
// the scene's. Numbers without bound are "infinity", what is left to the tool is null. Files are relative to the
// state's folder.
#pragma once

#include "State.h"

#include <string>

namespace settings {

inline constexpr int kStateVersion = 1;

/// Throws host::Error with one line that names file, field, value and rule: for what is no state, for one of another
/// version, unknown fields, wrong types and values out of range.
State loadState(const std::filesystem::path& file);
/// Writes beside the file and renames. Throws host::Error.
void saveState(const std::filesystem::path& file, const State& state);

/// The same as text; `folder`: that of the state.
State parseState(const std::string& text, const std::string& where, const std::filesystem::path& folder);
std::string textOf(const State& state, const std::filesystem::path& folder);

/// Parts of it, on one line.
tyndall::Ambient parseAmbient(const std::string& text, const std::string& where);
tyndall::Medium parseMedium(const std::string& text, const std::string& where);
StateFog parseFog(const std::string& text, const std::string& where);
std::vector<StateLight> parseLights(const std::string& text, const std::string& where);
std::string textOf(const tyndall::Ambient& ambient);
std::string textOf(const tyndall::Medium& medium);
std::string textOf(const StateFog& fog);
std::string textOf(const std::vector<StateLight>& lights);

} // namespace settings
