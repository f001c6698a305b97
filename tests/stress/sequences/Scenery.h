// What an engine's scene looks like to a camera and to its lights: depth and maps by rays that are cast at boxes.
#pragma once

#include "Script.h"

namespace stress {

/// The pose of a mover's cube from -1 to 1, without its mesh's shape.
glm::dmat4 poseOf(const MoverState& mover);

/// The cubes from -1 to 1 that a script shows, placed in the world.
std::vector<glm::dmat4> cubesOf(const ScriptState& state);

/// The camera of an eye, jittered by what it names.
tyndall::Camera cameraOf(const CameraState& state, const std::array<double, 2>& jitter, int width, int height);

/// A light without its textures; views of rectangle and layer 0.
tyndall::Light lightOf(const LightState& state);

/// Window depths of an image, row 0 at the bottom, as a projection with that depth range stores them.
std::vector<float> castDepth(const std::vector<glm::dmat4>& cubes, const tyndall::Mat4& clipFromWorld,
                             tyndall::ClipDepth clipDepth, bool reversed, int width, int height);

/// The glass that a light sees: depths, and RGB.
struct GlassImage {
  std::vector<float> depth, colour;
};
GlassImage castGlass(const tyndall::Mat4& clipFromWorld, int size);

glm::dmat4 toGlm(const tyndall::Mat4& matrix);
tyndall::Mat4 fromGlm(const glm::dmat4& matrix);

} // namespace stress
