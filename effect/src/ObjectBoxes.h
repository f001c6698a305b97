// The boxes of Frame::objects: those of meshes are fitted when first seen, and remembered; and what shape a view's last
// frame saw them in.
#pragma once

#include "gl/Functions.h"

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// The meshes that a view's frames have named, in the shape that they had in its last frame: one that deforms covers
/// the box of that shape, too.
class LastShapes {
public:
  /// Null for a mesh that was not named.
  const glm::dmat4* meshFromBox(const MeshVertices& mesh) const;
  void set(const MeshVertices& mesh, const glm::dmat4& meshFromBox);
  void clear() { shapes_.clear(); }

private:
  struct Shape {
    MeshVertices mesh;
    glm::dmat4 meshFromBox;
  };
  std::vector<Shape> shapes_;
};

class ObjectBoxes {
public:
  explicit ObjectBoxes(const gl::Functions& gl) : gl_(gl) {}

  /// Makes boxes of the frame's objects, and enters their shapes. Without the last shape of one of them the frame
  /// becomes one that compares all (Changes::Detect, no version). Reads buffers, for which it waits, and binds them:
  /// call it under a StateGuard. Errors name the field: a buffer that does not exist, is mapped, is too short or holds
  /// what is not finite.
  Status makeBoxes(Frame& frame, LastShapes& shapes);

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
