#include "ObjectBoxes.h"

#include "optics/Matrices.h"
#include "optics/MeshBox.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

constexpr std::size_t kRemembered = 1024;

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

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

const MeshVertices* LastShapes::of(const MeshVertices& mesh) const {
  const auto found =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const MeshVertices& m) { return isSameMesh(m, mesh); });
  return found == shapes_.end() ? nullptr : &*found;
}

void LastShapes::set(const MeshVertices& mesh) {
  const auto found =
      std::find_if(shapes_.begin(), shapes_.end(), [&](const MeshVertices& m) { return isSameMesh(m, mesh); });
  if (found != shapes_.end()) shapes_.erase(found);
  if (shapes_.size() == kRemembered) shapes_.erase(shapes_.begin());
  shapes_.push_back(mesh);
}

Status ObjectBoxes::makeBoxes(Frame& frame, LastShapes& shapes) {
  for (const MeshReader::Mesh& mesh : reader_.receive())
    enter(mesh);
  Status status = place(frame, shapes);
  reader_.send();
  return status;
}

Status ObjectBoxes::place(Frame& frame, LastShapes& shapes) {
  bool knowsAll = true;
  LastShapes now = shapes;
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    MovingObject& object = frame.objects[i];
    if (object.mesh.buffer == 0) continue;
    const MeshVertices* shape = shapes.of(object.mesh);
    const Fitted* last = shape ? known(*shape) : nullptr;
    const glm::dmat4 lastBox = last ? last->meshFromBox : glm::dmat4(1);
    const Fitted* found = nullptr;
    if (Status s = find("objects[" + std::to_string(i) + "].mesh.", object.mesh, found); !s) return s;
    now.set(object.mesh);
    knowsAll = knowsAll && found && last;
    if (found) object.worldFromObject = toMat4(optics::toGlm(object.worldFromObject) * found->meshFromBox);
    object.lastWorldFromObject = toMat4(optics::toGlm(object.lastWorldFromObject) * lastBox);
    object.mesh = {};
  }
  shapes = now;
  if (!knowsAll && frame.reuse.changes == Changes::Objects) compareAll(frame);
  return {};
}

// Null while it is not known.
Status ObjectBoxes::find(const std::string& field, const MeshVertices& mesh, const Fitted*& found) {
  if (mesh.version == 0) return reader_.check(field, mesh); // known too late, whenever it is read
  found = known(mesh);
  if (!found) return reader_.ask(field, mesh);
  if (found->fault.empty()) return {};
  return {StatusCode::InvalidFrame,
          "Frame::" + field + "buffer is " + std::to_string(mesh.buffer) + ": " + found->fault};
}

const ObjectBoxes::Fitted* ObjectBoxes::known(const MeshVertices& mesh) {
  const auto same = std::find_if(fitted_.begin(), fitted_.end(), [&](const Fitted& f) {
    return isSameMesh(f.mesh, mesh) && f.mesh.version == mesh.version;
  });
  if (same == fitted_.end()) return nullptr;
  std::rotate(same, same + 1, fitted_.end());
  return &fitted_.back();
}

void ObjectBoxes::enter(const MeshReader::Mesh& mesh) {
  Fitted fitted{mesh.vertices, glm::dmat4(1), {}};
  const auto broken =
      std::find_if(mesh.points.begin(), mesh.points.end(), [](const glm::vec3& point) { return !isFinite(point); });
  if (broken == mesh.points.end())
    fitted.meshFromBox = optics::boxAround(mesh.points);
  else
    fitted.fault = "its vertex " + std::to_string(broken - mesh.points.begin()) + " is not finite";
  if (fitted_.size() == kRemembered) fitted_.erase(fitted_.begin());
  fitted_.push_back(fitted);
}

} // namespace tyndall
