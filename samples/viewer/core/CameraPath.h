// A camera's path as it was recorded.
#pragma once

#include <settings/State.h>
#include <vector>

namespace viewer {

/// Adds a view at a time, if that is not too soon after the last one and there is room. Where the camera rested, its
/// last moment moves on instead.
void addPoint(std::vector<settings::PathPoint>& path, double seconds, const settings::LookAt& view);

/// The view at a time, on straight lines between the points; before the first and after the last it is theirs. The path
/// has a point at least.
settings::LookAt viewAt(const std::vector<settings::PathPoint>& path, double seconds);

} // namespace viewer
