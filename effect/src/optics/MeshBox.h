// A box around a mesh's vertices.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace tyndall::optics {

/// Places the cube from -1 to 1 around all of the points: along the coordinate axes or along the points' principal
/// axes, whichever has less volume; at least 1e-4 of its longest side thick. The points must be finite and not none.
glm::dmat4 boxAround(const std::vector<glm::vec3>& points);

} // namespace tyndall::optics
