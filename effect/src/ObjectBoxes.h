// The boxes of Frame::objects: those of meshes are fitted when first seen, and remembered.
#pragma once

#include "gl/Functions.h"

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

class ObjectBoxes {
public:
  explicit ObjectBoxes(const gl::Functions& gl) : gl_(gl) {}

  /// The frame's objects, all as boxes. Reads buffers, for which it waits, and binds them: call it under a StateGuard.
  /// Errors name the field: a buffer that does not exist, is mapped, is too short or holds what is not finite.
  Status boxesOf(const Frame& frame, std::vector<MovingObject>& boxes);

private:
  struct Fitted {
    MeshVertices mesh;
    glm::dmat4 meshFromBox;
  };
  Status fit(const std::string& field, const MeshVertices& mesh, glm::dmat4& meshFromBox);
  Status read(const std::string& field, const MeshVertices& mesh, std::vector<glm::vec3>& points) const;

  const gl::Functions& gl_;
  std::vector<Fitted> fitted_; // the one used last at the end
};

} // namespace tyndall
