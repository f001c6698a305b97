// What keeps a picture from being what one expects though nothing in the scene is an error.
#pragma once

#include <scene/View.h>

namespace host {

/// A note on a near plane so close that the depth buffer, 32-bit floats, no longer tells distances apart. Throws Error
/// if the scene is so large or so small that 32-bit floats do not hold the squares of its lengths.
Notes adviceOn(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera);

/// A mesh around the camera and all that it sees, a dome of sky for instance.
struct Enclosure {
  std::string mesh; ///< as a note names it
  int light = 0;    ///< index of the light that it seems to keep out
};

/// Meshes that may keep a directional light out: all the places that were tried are in their shadow. Windows may be
/// smaller than that.
std::vector<Enclosure> enclosuresOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                                    const tyndall::Camera& camera, const std::vector<tyndall::Light>& lights);

} // namespace host
