#include <scene/View.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <scene/Error.h>
#include <scene/Projection.h>
#include <scene/WorldGeometry.h>

namespace host {

namespace {

constexpr double kDegrees = 3.14159265358979323846 / 180;
constexpr double kDefaultFov = 50;

/// A standard depth buffer keeps useful resolution down to this ratio of near to far plane.
constexpr double kLeastNear = 1e-4;

std::string text(const glm::dvec3& v) { return fmt::format("{:.4g},{:.4g},{:.4g}", v.x, v.y, v.z); }

tyndall::Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// The axis of a node as a unit vector; throws if the node's matrix makes it vanish.
glm::dvec3 axisOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, int node, int axis) {
  const glm::dvec3 direction(worldFromNode[node][axis]);
  const double length = glm::length(direction);
  if (!(length > 0) || !std::isfinite(length))
    throw Error(fmt::format("node {} \"{}\": its matrix leaves no direction to look or shine along", node,
                            scene.nodes[node].name));
  return direction / length;
}

tyndall::Camera compose(const glm::dmat4& viewFromWorld, const glm::dmat4& clipFromView, const CameraOptions& options) {
  tyndall::Camera camera;
  camera.viewFromWorld = toMat4(viewFromWorld);
  camera.clipFromView = toMat4(clipFromView);
  camera.clipDepth = options.clipDepth;
  return camera;
}

/// What the middle of a scene sees in 26 directions.
struct Surroundings {
  int directions = 0;
  int hits = 0;
  int fronts = 0;
  bool isClosed() const { return hits == directions; }
};

Surroundings surroundingsOf(const WorldGeometry& geometry, const glm::dvec3& middle) {
  Surroundings seen;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const auto hit = firstHit(geometry, middle, glm::normalize(glm::dvec3(x, y, z)));
        seen.hits += hit ? 1 : 0;
        seen.fronts += hit && hit->front ? 1 : 0;
        ++seen.directions;
      }
  return seen;
}

/// A room shows the front of its walls to whoever stands in its middle, a solid thing the back of its skin. A shell
/// that was modelled from outside is told from a solid thing by its windows.
bool isRoom(const Scene& scene, const Surroundings& seen) {
  const bool hasWindows = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return material.isGlass() || material.alphaMode == AlphaMode::Blend;
  });
  return 3 * seen.fronts >= 2 * seen.directions || (seen.isClosed() && hasWindows);
}

/// How far from the middle an eye has to be for the geometry to fill its view; `towards` is the unit direction to the
/// eye.
double distanceToFit(const WorldGeometry& geometry, const glm::dvec3& middle, const glm::dvec3& towards,
                     double tanHalfWidth, double tanHalfHeight) {
  constexpr double kMargin = 1.05;
  const glm::dmat3 viewFromWorld(viewLooking({0, 0, 0}, -towards));
  double distance = 0;
  for (const glm::dvec3& point : geometry.points) {
    const glm::dvec3 view = viewFromWorld * (point - middle);
    distance =
        std::max({distance, view.z + std::abs(view.x) / tanHalfWidth, view.z + std::abs(view.y) / tanHalfHeight});
  }
  return distance > 0 ? kMargin * distance : 1;
}

} // namespace

std::vector<int> cameraNodes(const Scene& scene) {
  std::vector<int> nodes;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node)
    if (scene.nodes[node].camera >= 0) nodes.push_back(static_cast<int>(node));
  return nodes;
}

tyndall::Camera makeCamera(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, int index, double aspect,
                           const CameraOptions& options) {
  const std::vector<int> nodes = cameraNodes(scene);
  const int count = static_cast<int>(nodes.size());
  if (index < 0 || index >= count)
    throw Error(count == 0 ? fmt::format("camera {}: the scene has no camera", index)
                           : fmt::format("camera {}: must be 0 to {}, the scene's cameras", index, count - 1));
  const int node = nodes[index];
  const Camera& camera = scene.cameras[scene.nodes[node].camera];
  const ClipConvention convention{options.reversedDepth, options.clipDepth};
  const glm::dvec3 forward = -axisOf(scene, worldFromNode, node, 2);
  const glm::dvec3 up = axisOf(scene, worldFromNode, node, 1);
  const glm::dmat4 viewFromWorld = viewLooking(glm::dvec3(worldFromNode[node][3]), forward, up);
  if (camera.orthographic)
    return compose(
        viewFromWorld,
        orthographic(camera.halfHeight * aspect, camera.halfHeight, camera.nearPlane, camera.farPlane, convention),
        options);
  const double halfHeight = std::tan(0.5 * camera.verticalFov);
  const double farPlane = camera.farPlane > 0 ? camera.farPlane : std::numeric_limits<double>::infinity();
  return compose(viewFromWorld, perspective(halfHeight * aspect, halfHeight, camera.nearPlane, farPlane, convention),
                 options);
}

tyndall::Camera makeLookAt(const glm::dvec3& eye, const glm::dvec3& target, double fovDegrees, double aspect,
                           double nearPlane, double farPlane, const CameraOptions& options) {
  if (eye == target) throw Error(fmt::format("eye {}: must differ from the target", text(eye)));
  const double halfHeight = std::tan(0.5 * kDegrees * fovDegrees);
  return compose(
      viewLooking(eye, target - eye),
      perspective(halfHeight * aspect, halfHeight, nearPlane, farPlane, {options.reversedDepth, options.clipDepth}),
      options);
}

tyndall::Camera makeLookAt(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, const glm::dvec3& eye,
                           const glm::dvec3& target, double fovDegrees, double aspect, const CameraOptions& options) {
  if (eye == target) throw Error(fmt::format("eye {}: must differ from the target", text(eye)));
  const double halfHeight = std::tan(0.5 * kDegrees * fovDegrees);
  const auto range = depthRangeInPyramid(visibleGeometry(scene, worldFromNode), viewLooking(eye, target - eye),
                                         halfHeight * aspect, halfHeight);
  // Without triangles any planes do: take them from the one length there is.
  const double farPlane = 1.01 * (range && range->farthest > 0 ? range->farthest : glm::distance(eye, target));
  const double nearPlane = std::clamp(0.99 * (range ? range->nearest : 0), kLeastNear * farPlane, 0.9 * farPlane);
  return makeLookAt(eye, target, fovDegrees, aspect, nearPlane, farPlane, options);
}

tyndall::Camera makeDefaultCamera(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, double aspect,
                                  const CameraOptions& options, Notes& notes) {
  const Bounds bounds = boundsOf(scene, worldFromNode);
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  const glm::dvec3 size = bounds.high - bounds.low;
  const WorldGeometry geometry = visibleGeometry(scene, worldFromNode);
  glm::dvec3 eye;
  double fov = kDefaultFov;
  if (isRoom(scene, surroundingsOf(geometry, middle))) {
    const glm::dvec3 along = size.x >= size.z ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const auto wall = firstHit(geometry, middle, along);
    eye = middle + along * (wall ? 0.9 * wall->distance : 0.4 * glm::dot(size, along));
    fov = 65;
  } else {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 0.6, 1.2));
    const double tangent = std::tan(0.5 * kDegrees * fov);
    eye = middle + towards * distanceToFit(geometry, middle, towards, tangent * aspect, tangent);
  }
  notes.push_back(fmt::format("scene has no camera: looking from {} to {}", text(eye), text(middle)));
  return makeLookAt(scene, worldFromNode, eye, middle, fov, aspect, options);
}

tyndall::Light makeSun(const glm::dvec3& direction) {
  tyndall::Light sun;
  sun.kind = tyndall::LightKind::Directional;
  sun.direction = toVec3(direction);
  sun.colour = {3.2F, 3.0F, 2.7F};
  return sun;
}

std::vector<tyndall::Light> makeLights(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode, Notes& notes) {
  std::vector<tyndall::Light> lights;
  int left = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].light < 0) continue;
    if (lights.size() == tyndall::kMaxLights) {
      ++left;
      continue;
    }
    const Light& source = scene.lights[scene.nodes[i].light];
    tyndall::Light light;
    light.kind = source.kind;
    light.position = toVec3(glm::dvec3(worldFromNode[i][3]));
    if (source.kind != tyndall::LightKind::Point)
      light.direction = toVec3(-axisOf(scene, worldFromNode, static_cast<int>(i), 2));
    light.colour = {source.colour.r, source.colour.g, source.colour.b};
    light.range = source.range;
    light.innerConeAngle = source.innerConeAngle;
    light.outerConeAngle = source.outerConeAngle;
    lights.push_back(light);
  }
  if (left > 0) notes.push_back(fmt::format("scene has too many lights: the last {} are left out", left));
  if (lights.empty()) {
    // From behind the scene and its left side, as makeDefaultCamera() sees it, so that shafts come towards the eye.
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.77, -1, 0.14));
    lights.push_back(makeSun(direction));
    notes.push_back(fmt::format("scene has no light: a sun shines along {}", text(direction)));
  }
  return lights;
}

glm::vec3 skyOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                const std::vector<tyndall::Light>& lights, Notes& notes) {
  if (scene.skyRadiance != glm::vec3(0)) return scene.skyRadiance;
  constexpr glm::vec3 kClearDay(0.025F, 0.033F, 0.048F); // 1/sr, of the sun's irradiance
  constexpr float kIndoors = 0.12F;
  glm::vec3 sky(0);
  for (const tyndall::Light& light : lights)
    if (light.kind == tyndall::LightKind::Directional)
      sky += kClearDay * glm::vec3(light.colour[0], light.colour[1], light.colour[2]);
  if (sky == glm::vec3(0)) return sky;
  const Bounds bounds = boundsOf(scene, worldFromNode);
  const Surroundings seen = surroundingsOf(worldGeometry(scene, worldFromNode), 0.5 * (bounds.low + bounds.high));
  if (seen.isClosed() && isRoom(scene, seen)) sky *= kIndoors;
  notes.push_back(fmt::format("scene has no sky: its radiance is {}, after the sun", text(sky)));
  return sky;
}

tyndall::Medium mediumOf(const Scene& scene, const Bounds& bounds, Notes& notes) {
  if (scene.medium) return *scene.medium;
  constexpr double kTransmittance = 0.75;
  constexpr double kScatteredShare = 0.95;
  constexpr double kDepth = 2; // diagonals; an endless haze would outshine what stands in it
  const double diagonal = glm::distance(bounds.low, bounds.high);
  const double extinction = -std::log(kTransmittance) / (diagonal > 0 ? diagonal : 1);
  const auto scattering = static_cast<float>(kScatteredShare * extinction);
  const auto absorption = static_cast<float>((1 - kScatteredShare) * extinction);
  tyndall::Medium medium;
  medium.constituents = {{{scattering, scattering, scattering}, tyndall::Phase::HenyeyGreenstein, 0.5F}};
  medium.absorption = {absorption, absorption, absorption};
  if (diagonal > 0) medium.farDistance = kDepth * diagonal;
  notes.push_back(fmt::format("scene has no medium: a haze of extinction {:.4g} a unit, {:.0f} % scattered, g = 0.5, "
                              "ends at {:.4g} before the sky",
                              extinction, 100 * kScatteredShare, medium.farDistance));
  return medium;
}

} // namespace host
