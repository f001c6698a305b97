// The boxes of Frame::objects: those of meshes are fitted once their vertices have come back, and remembered; and in
// what version a view's last frame saw them.
#pragma once

#include "MeshReader.h"

#include <glm/glm.hpp>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// The meshes that an eye's frames have named, in the version that they had in its last frame: one that deforms covers
/// the box of that shape, too.
class LastShapes {
public:
  /// Null for a mesh that was not named.
  const MeshVertices* of(const MeshVertices& mesh) const;
  void set(const MeshVertices& mesh);
  void clear() { shapes_.clear(); }

private:
  std::vector<MeshVertices> shapes_;
};

class ObjectBoxes {
public:
  explicit ObjectBoxes(const gl::Functions& gl) : reader_(gl) {}

  /// Makes boxes of the frame's objects, and enters their shapes. While the box of one of them, as it is or as it was
  /// in the last frame, is not known, a frame of Changes::Objects becomes one that compares all (Changes::Detect, no
  /// version). Never waits. Binds buffers: call it under a StateGuard. Errors name the field: a buffer that does not
  /// exist, is mapped, is too short or, found when its vertices have come, holds what is not finite.
  Status makeBoxes(Frame& frame, LastShapes& shapes);

  /// GL memory held to read meshes.
  std::uint64_t bytes() const { return reader_.bytes(); }

private:
  struct Fitted {
    MeshVertices mesh;
    glm::dmat4 meshFromBox;
    std::string fault; // of what it holds; empty if it can be fitted
  };
  Status place(Frame& frame, LastShapes& shapes);
  Status find(const std::string& field, const MeshVertices& mesh, const Fitted*& found);
  const Fitted* known(const MeshVertices& mesh);
  void enter(const MeshReader::Mesh& mesh);

  MeshReader reader_;
  std::vector<Fitted> fitted_; // the one used last at the end
};

} // namespace tyndall
