// The JSON form of a medium: {"constituents": [{"scattering": [r, g, b], "phase": "henyey-greenstein", "g": 0.6}],
// "absorption": [r, g, b], "farDistance": d}. Coefficients in 1/world unit, the distance in world units.
// phase: isotropic (default), rayleigh, henyey-greenstein, cornette-shanks; g only for the last two.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tyndall/tyndall.h>

namespace host {

/// Throws Error, whose message begins with `where`, for an unknown key, a wrong type or length or a value out of range.
tyndall::Medium parseMedium(const nlohmann::json& json, const std::string& where);

/// Reads a JSON file; throws Error, which names the file, if it cannot be read or is not a medium.
tyndall::Medium loadMedium(const std::filesystem::path& file);

} // namespace host
