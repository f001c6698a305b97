#include <scene/Advice.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/Error.h>
#include <scene/Projection.h>
#include <scene/WorldGeometry.h>

namespace host {

namespace {

/// Found by scaling scenes: beyond these the effect's pictures of them change.
constexpr double kLargestLength = 1e15, kSmallestLength = 1e-16;

glm::dvec3 eyeOf(const tyndall::Camera& camera) { return glm::dvec3(glm::inverse(fromMat4(camera.viewFromWorld))[3]); }

/// Farthest distance from the eye to a point.
double reachOf(const WorldGeometry& geometry, const glm::dvec3& eye) {
  double reach = 0;
  for (const glm::dvec3& point : geometry.points)
    reach = std::max(reach, glm::distance(point, eye));
  return reach;
}

void requireFloatRange(double reach) {
  if (reach <= kLargestLength && (reach >= kSmallestLength || reach == 0)) return;
  throw Error(fmt::format("scene: reaches {:.3g} units from the camera, must be {:g} to {:g} for 32-bit floats to hold "
                          "the squares of lengths: scale it, and the medium with it",
                          reach, kSmallestLength, kLargestLength));
}

/// Depth is 1 - n / t, a little less with a far plane, and rounded to halves of 2^-24: at distance t that is t^2 / n as
/// much. Reversed depth is n / t, whose rounding shrinks with it.
void noteDepthPrecision(const WorldGeometry& geometry, const tyndall::Camera& camera, double reach, Notes& notes) {
  constexpr double kRounding = 1.0 / (1 << 25);
  constexpr double kMost = 1e-3; ///< relative error of a distance that is not worth a word
  const glm::dmat4 clipFromView = fromMat4(camera.clipFromView);
  const bool isPerspective = clipFromView[2][3] != 0;
  const bool isStandard = clipFromView[2][2] < 0;
  if (!isPerspective || !isStandard) return;
  const double lowest = camera.clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
  const double nearPlane = clipFromView[3][2] / (clipFromView[2][2] + lowest);
  if (!(kRounding * reach / nearPlane > kMost)) return;
  const auto range =
      depthRangeInPyramid(geometry, fromMat4(camera.viewFromWorld), 1 / clipFromView[0][0], 1 / clipFromView[1][1]);
  const double farthest = range ? range->farthest : 0;
  const double error = kRounding * farthest / nearPlane;
  if (!(error > kMost)) return;
  notes.push_back(
      fmt::format("camera: with its near plane at {:.3g} the depth buffer holds a distance of {:.3g} no better than to "
                  "{:.2g} %, and "
                  "shafts that end there may be as wrong: move the near plane to {:.2g} or reverse the depth",
                  nearPlane, farthest, 100 * error, nearPlane * error / kMost));
}

/// The triangles of a node that stop light.
struct Caster {
  int node = 0;
  WorldGeometry geometry;
};

std::vector<Caster> castersAround(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                                  const glm::dvec3& eye) {
  std::vector<Caster> casters;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    Caster caster{static_cast<int>(node), opaqueGeometry(scene, worldFromNode, static_cast<int>(node))};
    glm::bvec3 above(false), below(false);
    for (const glm::dvec3& point : caster.geometry.points)
      for (int axis = 0; axis < 3; ++axis) {
        above[axis] = above[axis] || point[axis] > eye[axis];
        below[axis] = below[axis] || point[axis] < eye[axis];
      }
    if (glm::all(above) && glm::all(below)) casters.push_back(std::move(caster));
  }
  return casters;
}

/// Whether every ray from the eye, in 26 directions, ends at a surface, and the caster stands between the light and all
/// that was tried of these rays.
bool keepsOut(const WorldGeometry& caster, const WorldGeometry& all, const glm::dvec3& eye, const glm::dvec3& toLight) {
  for (int direction = 0; direction < 27; ++direction) {
    const glm::dvec3 offset(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
    if (offset == glm::dvec3(0)) continue;
    const glm::dvec3 along = glm::normalize(offset);
    auto end = firstHit(caster, eye, along);
    if (!end) end = firstHit(all, eye, along);
    if (!end) return false;
    for (const double share : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95})
      if (!firstHit(caster, eye + share * end->distance * along, toLight)) return false;
  }
  return true;
}

std::string nameOf(const Scene& scene, int node) {
  const Node& owner = scene.nodes[static_cast<std::size_t>(node)];
  const std::string& mesh = scene.meshes[static_cast<std::size_t>(owner.mesh)].name;
  return fmt::format("mesh \"{}\" of node {} \"{}\"", mesh, node, owner.name);
}

} // namespace

Notes adviceOn(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera) {
  Notes notes;
  const WorldGeometry visible = visibleGeometry(scene, worldFromNode);
  const double reach = reachOf(visible, eyeOf(camera));
  requireFloatRange(reach);
  noteDepthPrecision(visible, camera, reach, notes);
  return notes;
}

std::vector<Enclosure> enclosuresOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                                    const tyndall::Camera& camera, const std::vector<tyndall::Light>& lights) {
  std::vector<Enclosure> enclosures;
  const glm::dvec3 eye = eyeOf(camera);
  const std::vector<Caster> casters = castersAround(scene, worldFromNode, eye);
  if (casters.empty()) return enclosures;
  const WorldGeometry all = worldGeometry(scene, worldFromNode);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].kind != tyndall::LightKind::Directional) continue;
    const glm::dvec3 toLight = -glm::dvec3(lights[i].direction[0], lights[i].direction[1], lights[i].direction[2]);
    for (const Caster& caster : casters)
      if (keepsOut(caster.geometry, all, eye, toLight))
        enclosures.push_back({nameOf(scene, caster.node), static_cast<int>(i)});
  }
  return enclosures;
}

} // namespace host
