// The JSON forms of a medium and of ambient light. A medium: {"constituents": [{"scattering": [r, g, b], "phase":
// "henyey-greenstein", "g": 0.6}], "absorption": [r, g, b], "farDistance": d}. Coefficients in 1/world unit, the
// distance in world units. phase: isotropic (default), rayleigh, henyey-greenstein, cornette-shanks; g only for the
// last two. What thins out with height: "layers": [{"height": h, "scale": H, "ground": h}] (world units; without a
// scale density is the same everywhere, without a ground it grows on below), at most two, along "up": [x, y, z] ([0, 1,
// 0]); "layer": i of a constituent, and "absorptionLayer": i, are those that they follow. "dimsBackground": false makes
// it add its light and dim nothing. In place of all that {"atmosphere": {"metre": u, "seaLevel": h, "haze": x, "up":
// [x, y, z]}} is Earth's air (tyndall/atmosphere.h), each with its default. Light of the surroundings: {"radiance": [r,
// g, b], "harmonics": [[r, g, b], ...]}, of which there are at most nine; what is left out is 0.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <scene/Scene.h>
#include <string>
#include <tyndall/tyndall.h>

namespace host {

/// Throws Error, whose message begins with `where`, for an unknown key, a wrong type or length or a value out of range.
tyndall::Medium parseMedium(const nlohmann::json& json, const std::string& where);

/// Likewise, without an occlusion texture.
tyndall::Ambient parseAmbient(const nlohmann::json& json, const std::string& where);

/// What banks of fog scatter: {"albedo": [r, g, b], "phase": "henyey-greenstein", "g": 0.6}, each with its default, g
/// as of a constituent. Likewise.
FogScattering parseFogScattering(const nlohmann::json& json, const std::string& where);

/// Reads a JSON file; throws Error, which names the file, if it cannot be read or is not a medium, or not ambient
/// light.
tyndall::Medium loadMedium(const std::filesystem::path& file);
tyndall::Ambient loadAmbient(const std::filesystem::path& file);

} // namespace host
