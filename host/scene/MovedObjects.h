// What moved between two poses of a scene, as Tyndall's Frame::objects wants it.
#pragma once

#include "scene/Scene.h"

namespace host {

/// The bounds of each mesh in its own coordinates.
std::vector<Bounds> meshBounds(const Scene& scene);

/// A box for every node with a mesh whose transform differs between the poses (worldFromNode of each node).
std::vector<tyndall::MovingObject> movedObjects(const Scene& scene, const std::vector<Bounds>& bounds,
                                                const std::vector<glm::dmat4>& last,
                                                const std::vector<glm::dmat4>& now);

/// The world-space box around something that changes, in the last frame and in this one.
tyndall::MovingObject movedBox(const Bounds& last, const Bounds& now);

} // namespace host
