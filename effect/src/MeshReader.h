// Reads the vertices of meshes back without waiting: they are copied to buffers of the effect's own, and looked at in a
// later frame, when the GPU is done.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// The same vertices of a buffer, in whatever version.
bool isSameMesh(const MeshVertices& a, const MeshVertices& b);

class MeshReader {
public:
  struct Mesh {
    MeshVertices vertices;
    std::vector<glm::vec3> points;
  };

  explicit MeshReader(const gl::Functions& gl) : gl_(gl) {}
  ~MeshReader();
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;

  /// Every rule of a mesh's buffer but what it holds; an error names the field. Binds to the uniform target, as all
  /// others do.
  Status check(const std::string& field, const MeshVertices& mesh) const;

  /// Has a mesh copied, as much of it as there is room for: to be called in every frame that names the mesh until it
  /// has come. Another version of it that is under way is forgotten. Binds to the pixel unpack target, too, where it
  /// leaves nothing.
  Status ask(const std::string& field, const MeshVertices& mesh);

  /// Ends a frame's asking.
  void send();

  /// Those that have come since the last call.
  std::vector<Mesh> receive();

  /// GL memory held.
  std::uint64_t bytes() const;

private:
  /// A mesh under way.
  struct Reading {
    std::uint64_t id = 0;
    Mesh mesh; // with the points that have come
    std::uint32_t asked = 0;
    std::uint32_t came = 0;
  };
  /// A run of a mesh's vertices in a batch.
  struct Piece {
    std::uint64_t reading = 0;
    std::uint32_t first = 0, count = 0;
    std::uint64_t at = 0; // bytes
  };
  /// What one frame had copied.
  struct Batch {
    gl::Buffer buffer; // null until it is first needed
    gl::Sync sync = nullptr;
    std::uint64_t used = 0;
    std::vector<Piece> pieces;
  };

  Reading& readingOf(const MeshVertices& mesh);
  Status makeRoom(Batch*& batch);
  void copy(Batch& batch, Reading& reading, std::uint32_t count) const;
  void take(const Batch& batch);

  const gl::Functions& gl_;
  std::array<Batch, 3> batches_; // as many frames as an engine has under way
  Batch* filling_ = nullptr;     // this frame's
  std::vector<Reading> readings_;
  std::uint64_t count_ = 0;
};

} // namespace tyndall
