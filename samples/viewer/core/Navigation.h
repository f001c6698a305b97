// How a view moves: around its target, or through the scene as one flies.
#pragma once

#include <scene/Scene.h>
#include <settings/State.h>
#include <tyndall/tyndall.h>

namespace viewer {

using settings::LookAt;

/// The view of a camera, y up, with its target `distance` in front of it. An orthographic camera becomes a perspective
/// one that shows as much there.
LookAt lookAtOf(const tyndall::Camera& camera, double distance);

/// Turns the eye around the target. Radians, to the right and up; straight up and down are never reached.
LookAt orbited(const LookAt& view, double right, double up);
/// Turns the target around the eye.
LookAt turned(const LookAt& view, double right, double up);
/// Moves both, in units of the distance between them.
LookAt panned(const LookAt& view, double right, double up);
/// Moves the eye to `factor` times its distance from the target.
LookAt zoomed(const LookAt& view, double factor);
/// Moves both by world units to the right, up and forward.
LookAt flown(const LookAt& view, const glm::dvec3& step);
/// The same direction, from where all of the bounds is seen.
LookAt framed(const LookAt& view, const host::Bounds& bounds, double aspect);

/// The direction of a picture's point, (0, 0) at the left bottom, (1, 1) at the right top.
glm::dvec3 rayOf(const LookAt& view, double aspect, const glm::dvec2& point);
/// Where a place is in the picture, and its distance along the view axis in z; behind the eye z is negative.
glm::dvec3 projected(const LookAt& view, double aspect, const glm::dvec3& place);

} // namespace viewer
