// From a posed scene to what the effect takes: camera, lights, medium. What a scene lacks is made up, and noted.
#pragma once

#include <glm/glm.hpp>
#include <scene/Scene.h>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace host {

struct CameraOptions {
  bool reversedDepth = false;
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
};

using Notes = std::vector<std::string>;

/// The nodes that carry a camera, in the order of Scene::nodes: camera N of the user is the N-th of them.
std::vector<int> cameraNodes(const Scene& scene);

/// Camera `index` of cameraNodes() for an image of width / height = aspect. Its vertical extent holds whatever the
/// aspect, and the node's scale has no effect. Throws Error if there is no such camera or its node is squashed flat.
tyndall::Camera makeCamera(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, int index, double aspect,
                           const CameraOptions& options = {});

/// A perspective camera at eye with target in the middle and y up. Near and far plane hold all triangles in the view.
/// fovDegrees: the vertical angle, inside (0, 180). Throws Error if eye and target coincide.
tyndall::Camera makeLookAt(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, const glm::dvec3& eye,
                           const glm::dvec3& target, double fovDegrees, double aspect,
                           const CameraOptions& options = {});

/// The same with given planes; farPlane may be infinite.
tyndall::Camera makeLookAt(const glm::dvec3& eye, const glm::dvec3& target, double fovDegrees, double aspect,
                           double nearPlane, double farPlane, const CameraOptions& options = {});

/// A view for a scene without a camera: along the length of a closed room from inside, of anything else from the front,
/// the right and above. Adds a note.
tyndall::Camera makeDefaultCamera(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, double aspect,
                                  const CameraOptions& options, Notes& notes);

/// All lights of the scene; a sun if there are none (noted), the first kMaxLights if there are more (noted).
/// Shadow and glass maps are left empty.
std::vector<tyndall::Light> makeLights(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, Notes& notes);

/// Sunlight of the colour that a scene without lights gets. direction: where the light travels to.
tyndall::Light makeSun(const glm::dvec3& direction);

/// The scene's sky, or if it has none that of a clear day under the directional lights (noted); black without those. It
/// is dimmed in a closed room: the host's ambient light knows no walls.
glm::vec3 skyOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                const std::vector<tyndall::Light>& lights, Notes& notes);

/// The scene's medium, or a thin haze scaled to the bounds (noted): 3/4 of the light crosses their diagonal, and the
/// haze ends two diagonals away.
tyndall::Medium mediumOf(const Scene& scene, const Bounds& bounds, Notes& notes);

} // namespace host
