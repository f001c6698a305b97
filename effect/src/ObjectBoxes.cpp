#include "ObjectBoxes.h"

#include "gl/Enums.h"
#include "optics/Matrices.h"
#include "optics/MeshBox.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace tyndall {

namespace {

constexpr std::size_t kRemembered = 1024;

bool isSameMesh(const MeshVertices& a, const MeshVertices& b) {
  return a.buffer == b.buffer && a.offset == b.offset && a.stride == b.stride && a.count == b.count;
}

void compareAll(Frame& frame) {
  frame.objects.clear();
  frame.reuse.changes = Changes::Detect;
  frame.depth.version = 0;
  for (Light& light : frame.lights)
    light.shadow.version = 0;
}

Mat4 toMat4(const glm::dmat4& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 16; ++i)
    result[i] = m[static_cast<int>(i / 4)][static_cast<int>(i % 4)];
  return result;
}

Status invalid(const std::string& field, const std::string& rule) {
  return {StatusCode::InvalidFrame, "Frame::" + field + rule};
}

} // namespace

const glm::dmat4* LastShapes::meshFromBox(const MeshVertices& mesh) const {
  const auto found =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape& s) { return isSameMesh(s.mesh, mesh); });
  return found == shapes_.end() ? nullptr : &found->meshFromBox;
}

void LastShapes::set(const MeshVertices& mesh, const glm::dmat4& meshFromBox) {
  const auto found =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const Shape& s) { return isSameMesh(s.mesh, mesh); });
  const Shape shape{mesh, meshFromBox};
  if (found != shapes_.end()) shapes_.erase(found);
  if (shapes_.size() == kRemembered) shapes_.erase(shapes_.begin());
  shapes_.push_back(shape);
}

Status ObjectBoxes::makeBoxes(Frame& frame, LastShapes& shapes) {
  bool knowsAll = true;
  LastShapes now = shapes;
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    MovingObject& object = frame.objects[i];
    if (object.mesh.buffer == 0) continue;
    glm::dmat4 meshFromBox;
    if (Status s = fit("objects[" + std::to_string(i) + "].mesh.", object.mesh, meshFromBox); !s) return s;
    const glm::dmat4* last = shapes.meshFromBox(object.mesh);
    knowsAll = knowsAll && last;
    object.worldFromObject = toMat4(optics::toGlm(object.worldFromObject) * meshFromBox);
    object.lastWorldFromObject = toMat4(optics::toGlm(object.lastWorldFromObject) * (last ? *last : meshFromBox));
    now.set(object.mesh, meshFromBox);
    object.mesh = {};
  }
  shapes = now;
  if (!knowsAll) compareAll(frame);
  return {};
}

Status ObjectBoxes::fit(const std::string& field, const MeshVertices& mesh, glm::dmat4& meshFromBox) {
  const auto same = std::find_if(fitted_.begin(), fitted_.end(), [&](const Fitted& f) {
    return isSameMesh(f.mesh, mesh) && f.mesh.version == mesh.version;
  });
  if (mesh.version != 0 && same != fitted_.end()) {
    std::rotate(same, same + 1, fitted_.end());
    meshFromBox = fitted_.back().meshFromBox;
    return {};
  }
  std::vector<glm::vec3> points;
  if (Status s = read(field, mesh, points); !s) return s;
  meshFromBox = optics::boxAround(points);
  if (mesh.version == 0) return {};
  if (fitted_.size() == kRemembered) fitted_.erase(fitted_.begin());
  fitted_.push_back({mesh, meshFromBox});
  return {};
}

Status ObjectBoxes::read(const std::string& field, const MeshVertices& mesh, std::vector<glm::vec3>& points) const {
  const std::string buffer = field + "buffer is " + std::to_string(mesh.buffer) + ": ";
  if (!gl_.IsBuffer(mesh.buffer))
    return invalid(buffer, "not the name of a buffer in this context (deleted, or never bound?)");
  gl_.BindBuffer(gl::UNIFORM_BUFFER, mesh.buffer); // any target will do: this one is given back
  gl::Int mapped = 0, access = 0;
  gl_.GetBufferParameteriv(gl::UNIFORM_BUFFER, gl::BUFFER_MAPPED, &mapped);
  gl_.GetBufferParameteriv(gl::UNIFORM_BUFFER, gl::BUFFER_ACCESS_FLAGS, &access);
  if (mapped && !(static_cast<gl::Enum>(access) & gl::MAP_PERSISTENT_BIT)) return invalid(buffer, "it is mapped");
  gl::Int64 size = 0;
  gl_.GetBufferParameteri64v(gl::UNIFORM_BUFFER, gl::BUFFER_SIZE, &size);
  const std::uint64_t bytes = std::uint64_t{mesh.stride} * (mesh.count - 1) + sizeof(glm::vec3);
  const auto held = static_cast<std::uint64_t>(size);
  if (mesh.offset > held || bytes > held - mesh.offset)
    return invalid(field + "count is " + std::to_string(mesh.count),
                   ": with offset " + std::to_string(mesh.offset) + " and stride " + std::to_string(mesh.stride) +
                       " the last vertex ends behind the buffer's " + std::to_string(held) + " bytes");
  std::vector<unsigned char> data(bytes);
  gl_.GetBufferSubData(gl::UNIFORM_BUFFER, static_cast<gl::Intptr>(mesh.offset), static_cast<gl::Sizeiptr>(bytes),
                       data.data());
  points.resize(mesh.count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&points[i], &data[i * mesh.stride], sizeof(glm::vec3));
    if (!(std::isfinite(points[i].x) && std::isfinite(points[i].y) && std::isfinite(points[i].z)))
      return invalid(buffer, "its vertex " + std::to_string(i) + " is not finite");
  }
  return {};
}

} // namespace tyndall
