#include <scene/ShadowViews.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <scene/ConvexPolygon.h>
#include <scene/WorldGeometry.h>

namespace host {

namespace {

/// Added around the geometry, relative to its size, against the rounding of 32-bit rasterisation.
constexpr double kMargin = 1e-4;

/// Least near plane of a pyramid relative to its far plane: depth would have no resolution left with less.
constexpr double kLeastNear = 1e-5;

/// Widest half angle of a spot's map: the tangent grows without bound towards 90 degrees.
constexpr double kWidestHalfAngle = 85.0 * 3.14159265358979323846 / 180.0;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---------------------------------------------------------------------------------------------------------------------
// Directional

/// A plane p of points x with dot(p, (x, 1)) >= 0.
using Plane = glm::dvec4;

/// The view depths of a camera that one cascade serves.
struct Slice {
  double start = -kInfinity;
  double end = kInfinity;
};

/// A camera taken apart.
struct Frustum {
  glm::dmat4 viewFromWorld;
  glm::dmat4 clipFromView;
  bool isPerspective;
  double nearDepth; ///< view depth of the near plane

  explicit Frustum(const tyndall::Camera& camera)
      : viewFromWorld(fromMat4(camera.viewFromWorld)), clipFromView(fromMat4(camera.clipFromView)),
        isPerspective(clipFromView[2][3] != 0) {
    const double lowest = camera.clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
    nearDepth = std::min(viewDepthAt(lowest), viewDepthAt(1));
  }

  glm::dvec4 unproject(double x, double y, double z) const {
    return glm::inverse(clipFromView) * glm::dvec4(x, y, z, 1);
  }

  double viewDepthAt(double ndcZ) const {
    const glm::dvec4 point = unproject(0, 0, ndcZ);
    const double depth = -point.z / point.w;
    return depth > 0 || !isPerspective ? depth : kInfinity; // an infinite far plane may round to a point behind the eye
  }

  double viewDepth(const glm::dvec3& world) const { return -(viewFromWorld * glm::dvec4(world, 1)).z; }

  /// The world-space planes around the rays of a slice. Rays begin at the eye, not at the near plane, and end nowhere.
  std::vector<Plane> planes(const Slice& slice) const {
    const glm::dmat4 rows = glm::transpose(clipFromView * viewFromWorld);
    const Plane depth = -glm::transpose(viewFromWorld)[2];
    std::vector<Plane> result = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
    const double start = isPerspective ? slice.start : std::max(slice.start, std::min(0.0, nearDepth));
    if (std::isfinite(start)) result.push_back(depth - Plane(0, 0, 0, start));
    if (std::isfinite(slice.end)) result.push_back(Plane(0, 0, 0, slice.end) - depth);
    return result;
  }

  /// Where rays of a slice begin: at the eye, if not farther on.
  double startOf(const Slice& slice) const {
    return std::isfinite(slice.start) ? slice.start : std::min(0.0, nearDepth);
  }

  /// The positions of the four corner rays at a view depth, in view space.
  std::array<glm::dvec3, 4> corners(double depth) const {
    std::array<glm::dvec3, 4> result;
    for (int i = 0; i < 4; ++i) {
      const glm::dvec4 clip = unproject(i % 2 == 0 ? -1 : 1, i < 2 ? -1 : 1, 1 - 1e-3);
      const glm::dvec3 view = glm::dvec3(clip) / clip.w;
      result[i] = isPerspective ? view * (depth / -view.z) : glm::dvec3(view.x, view.y, -depth);
    }
    return result;
  }

  /// Of the slice's two ends, in world space.
  std::array<glm::dvec3, 8> worldCorners(const Slice& slice) const {
    const glm::dmat4 worldFromView = glm::inverse(viewFromWorld);
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
      result[i] = glm::dvec3(worldFromView * glm::dvec4(corners(i < 4 ? startOf(slice) : slice.end)[i % 4], 1));
    return result;
  }
};

/// The casters as the light sees them.
struct CasterShadow {
  glm::dmat4 lightFromWorld;       ///< rigid; light travels along -z
  std::vector<glm::dvec2> outline; ///< convex, in light space
  double nearest = kInfinity;      ///< distances along the light
  double farthest = -kInfinity;
  double size = 0; ///< of the casters' bounds in light space, diagonal
};

CasterShadow casterShadow(const WorldGeometry& geometry, const glm::dvec3& direction) {
  glm::dvec3 low(kInfinity);
  glm::dvec3 high(-kInfinity);
  for (const glm::dvec3& point : geometry.points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  CasterShadow shadow;
  shadow.lightFromWorld = viewLooking(0.5 * (low + high), direction);
  std::vector<glm::dvec2> flat;
  flat.reserve(geometry.points.size());
  for (const glm::dvec3& point : geometry.points) {
    const glm::dvec4 light = shadow.lightFromWorld * glm::dvec4(point, 1);
    flat.emplace_back(light);
    shadow.nearest = std::min(shadow.nearest, -light.z);
    shadow.farthest = std::max(shadow.farthest, -light.z);
  }
  shadow.outline = convexHull(std::move(flat));
  shadow.size = glm::length(high - low);
  return shadow;
}

/// The part of the outline that the rays of a slice can see below the nearest caster. With the planes in light space as
/// a x + b y + c z + d >= 0, some z satisfies them all exactly where those without c hold and where each pair of c > 0
/// and c' < 0 does after z is eliminated (Fourier and Motzkin): c (a', b', d') - c' (a, b, d) >= 0.
std::vector<glm::dvec2> visibleOutline(const CasterShadow& shadow, const Frustum& frustum, const Slice& slice) {
  const glm::dmat4 worldFromLight = glm::inverse(shadow.lightFromWorld);
  std::vector<Plane> planes = {Plane(0, 0, -1, -shadow.nearest)};
  for (const Plane& plane : frustum.planes(slice)) {
    const Plane light = plane * worldFromLight;
    planes.push_back(light / glm::length(glm::dvec3(light)));
  }
  std::vector<glm::dvec2> polygon = shadow.outline;
  for (const Plane& up : planes) {
    if (up.z == 0) polygon = cut(polygon, {up.x, up.y, up.w});
    if (up.z <= 0) continue;
    for (const Plane& down : planes) {
      if (down.z >= 0) continue;
      const Plane sum = up.z * down - down.z * up;
      polygon = cut(polygon, {sum.x, sum.y, sum.w});
    }
  }
  return polygon;
}

/// An edge-on caster has no width and a flat one no depth, but a box needs both.
glm::dvec2 withMargin(const glm::dvec2& halfSize, const CasterShadow& shadow) {
  return glm::max(halfSize * (1 + 2 * kMargin), glm::dvec2(kMargin * shadow.size));
}

tyndall::Mat4 boxAround(const CasterShadow& shadow, const Rectangle& rectangle, double farthest,
                        const ClipConvention& convention) {
  const double depthMargin = kMargin * std::max(farthest - shadow.nearest, 0.01 * shadow.size);
  const glm::dvec2 axis = rectangle.axis;
  glm::dmat4 boxFromLight(1);
  boxFromLight[0] = {axis.x, -axis.y, 0, 0};
  boxFromLight[1] = {axis.y, axis.x, 0, 0};
  boxFromLight[3] = {-glm::dot(axis, rectangle.centre), -glm::dot(glm::dvec2(-axis.y, axis.x), rectangle.centre), 0, 1};
  const glm::dmat4 clipFromBox = orthographic(rectangle.halfSize.x, rectangle.halfSize.y, shadow.nearest - depthMargin,
                                              farthest + depthMargin, convention);
  return toMat4(clipFromBox * boxFromLight * shadow.lightFromWorld);
}

/// The view depths between cascades: the practical scheme of Zhang et al. 2006, a mean of logarithmic and even steps.
std::vector<Slice> splitView(const Frustum& frustum, double end, int cascades) {
  constexpr double kLogarithmicShare = 0.75;
  const double start = frustum.isPerspective ? std::max(frustum.nearDepth, 1e-3 * end) : frustum.nearDepth;

  std::vector<Slice> slices = {Slice{}};
  for (int i = 1; i < cascades && end > start; ++i) {
    const double share = static_cast<double>(i) / cascades;
    const double even = start + (end - start) * share;
    const double depth = frustum.isPerspective
                             ? kLogarithmicShare * start * std::pow(end / start, share) + (1 - kLogarithmicShare) * even
                             : even;
    slices.back().end = depth;
    slices.push_back({depth, kInfinity});
  }
  return slices;
}

/// The next power of the eighth root of 2, below (up 0) or above (up 1).
double inSteps(double distance, int up) {
  constexpr double kSteps = 8; // of an octave
  if (!(distance > 0)) return distance;
  return std::exp2((std::floor(kSteps * std::log2(distance)) + up) / kSteps);
}

/// A point beyond the far plane falls to the next cascade, so each but the last reaches as deep as its slice.
double farthestOf(const CasterShadow& shadow, const Frustum& frustum, const Slice& slice) {
  double farthest = shadow.farthest;
  if (std::isinf(slice.end)) return farthest;
  for (const glm::dvec3& corner : frustum.worldCorners(slice))
    farthest = std::max(farthest, -(shadow.lightFromWorld * glm::dvec4(corner, 1)).z);
  return farthest;
}

/// What a cascade holds of the light's plane.
struct Cascade {
  Rectangle rectangle;
  double farthest = 0; ///< distance along the light
};

std::vector<Cascade> tightCascades(const CasterShadow& shadow, const WorldGeometry& geometry, const Frustum& frustum,
                                   int cascades) {
  double end = -kInfinity;
  for (const glm::dvec3& point : geometry.points)
    end = std::max(end, frustum.viewDepth(point));
  std::vector<Cascade> result;
  for (const Slice& slice : splitView(frustum, end, cascades)) {
    const std::vector<glm::dvec2> outline = visibleOutline(shadow, frustum, slice);
    if (outline.empty()) continue;
    Rectangle rectangle = smallestRectangle(outline);
    rectangle.halfSize = withMargin(rectangle.halfSize, shadow);
    result.push_back({rectangle, farthestOf(shadow, frustum, slice)});
  }
  return result;
}

/// The ball around a slice that ends. Centre and radius are of view space, and so the same however the camera stands.
struct Ball {
  glm::dvec3 centre{0};
  double radius = 0;
};

// On the line between the middles of the two ends, at the same distance t from the corners of both where it can be:
// t^2 length^2 + near^2 = (1 - t)^2 length^2 + far^2.
Ball ballAround(const Frustum& frustum, const Slice& slice) {
  const auto middleOf = [](const auto& corners) { return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]); };
  const auto reachOf = [](const auto& corners, const glm::dvec3& from) {
    double reach = 0;
    for (const glm::dvec3& corner : corners)
      reach = std::max(reach, glm::distance(from, corner));
    return reach;
  };
  const auto nearCorners = frustum.corners(frustum.startOf(slice));
  const auto farCorners = frustum.corners(slice.end);
  const glm::dvec3 from = middleOf(nearCorners);
  const glm::dvec3 along = middleOf(farCorners) - from;
  const double near = reachOf(nearCorners, from);
  const double far = reachOf(farCorners, from + along);
  const double t = std::clamp(0.5 + 0.5 * (far * far - near * near) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 centre = from + t * along;
  return {centre, std::max(reachOf(nearCorners, centre), reachOf(farCorners, centre))};
}

/// Around what is held by `texels` texels per side, one of them to spare, so that its corner can lie on the lattice
/// that goes through `origin`.
Rectangle onLattice(const glm::dvec2& centre, const glm::dvec2& halfSize, const glm::dvec2& origin, int texels) {
  if (texels < 2) return {centre, {1, 0}, halfSize}; // nothing to spare
  const glm::dvec2 texel = 2.0 * halfSize / double(texels - 1);
  const glm::dvec2 corner = origin + glm::floor((centre - halfSize - origin) / texel) * texel;
  return {corner + 0.5 * double(texels) * texel, {1, 0}, 0.5 * double(texels) * texel};
}

std::vector<Cascade> steadyCascades(const CasterShadow& shadow, const Frustum& frustum, int cascades, int texels) {
  glm::dvec2 low(kInfinity);
  glm::dvec2 high(-kInfinity);
  for (const glm::dvec2& corner : shadow.outline) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  const glm::dvec2 origin(shadow.lightFromWorld[3]);
  std::vector<Cascade> result;
  for (const Slice& slice : splitView(frustum, shadow.size, cascades)) {
    Cascade cascade{{0.5 * (low + high), {1, 0}, 0.5 * (high - low)}, shadow.farthest};
    if (std::isfinite(slice.end)) {
      const Ball ball = ballAround(frustum, slice);
      const glm::dmat4 lightFromView = shadow.lightFromWorld * glm::inverse(frustum.viewFromWorld);
      const glm::dvec3 centre(lightFromView * glm::dvec4(ball.centre, 1));
      for (int i = 0; i < 2; ++i)
        if (ball.radius < cascade.rectangle.halfSize[i]) {
          cascade.rectangle.centre[i] = centre[i];
          cascade.rectangle.halfSize[i] = ball.radius;
        }
      cascade.farthest = std::max(cascade.farthest, ball.radius - centre.z);
    }
    cascade.rectangle =
        onLattice(cascade.rectangle.centre, withMargin(cascade.rectangle.halfSize, shadow), origin, texels);
    result.push_back(cascade);
  }
  return result;
}

void fitDirectional(tyndall::Light& light, const WorldGeometry& geometry, const tyndall::Camera& camera,
                    const ShadowOptions& options) {
  const CasterShadow shadow =
      casterShadow(geometry, glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
  if (!(shadow.size > 0)) return;
  const Frustum frustum(camera);
  const std::vector<Cascade> cascades = options.steadyTexels > 0
                                            ? steadyCascades(shadow, frustum, options.cascades, options.steadyTexels)
                                            : tightCascades(shadow, geometry, frustum, options.cascades);
  std::vector<tyndall::ShadowView>& views = light.shadow.views;
  for (const Cascade& cascade : cascades)
    views.push_back({boxAround(shadow, cascade.rectangle, cascade.farthest, {options.reversedDepth, options.clipDepth}),
                     static_cast<int>(views.size())});
}

// ---------------------------------------------------------------------------------------------------------------------
// Spot and point

/// Adds a pyramid for each view matrix; all share the depth range of the casters inside any of them.
void fitPyramids(tyndall::Light& light, const WorldGeometry& geometry, const std::vector<glm::dmat4>& viewsFromWorld,
                 double tanHalfAngle, const ShadowOptions& options) {
  DepthRange range{kInfinity, 0};
  for (const glm::dmat4& viewFromWorld : viewsFromWorld) {
    const auto inside = depthRangeInPyramid(geometry, viewFromWorld, tanHalfAngle, tanHalfAngle);
    if (!inside) continue;
    range.nearest = std::min(range.nearest, inside->nearest);
    range.farthest = std::max(range.farthest, inside->farthest);
  }
  range.farthest = std::min(range.farthest, light.range);
  if (!(range.nearest <= range.farthest) || range.farthest <= 0) return;

  // In steps, so that what moves does not move them every frame: a new matrix makes all of the light anew.
  const double farPlane = inSteps(range.farthest * (1 + kMargin), 1);
  const double nearPlane = std::max(inSteps(range.nearest * (1 - kMargin), 0), kLeastNear * farPlane);
  const glm::dmat4 clipFromView =
      perspective(tanHalfAngle, tanHalfAngle, nearPlane, farPlane, {options.reversedDepth, options.clipDepth});
  for (const glm::dmat4& viewFromWorld : viewsFromWorld)
    light.shadow.views.push_back({toMat4(clipFromView * viewFromWorld), static_cast<int>(light.shadow.views.size())});
}

std::vector<std::string> fitSpot(tyndall::Light& light, const WorldGeometry& geometry, const ShadowOptions& options) {
  std::vector<std::string> notes;
  if (light.outerConeAngle > kWidestHalfAngle)
    notes.emplace_back(
        "a spot light is wider than its shadow map: nothing casts a shadow beyond 85 degrees from its axis");
  const double tanHalfAngle = std::tan(std::min(light.outerConeAngle, kWidestHalfAngle)) * (1 + kMargin);
  const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
  const glm::dvec3 direction(light.direction[0], light.direction[1], light.direction[2]);
  fitPyramids(light, geometry, {viewLooking(position, direction)}, tanHalfAngle, options);
  return notes;
}

void fitPoint(tyndall::Light& light, const WorldGeometry& geometry, const ShadowOptions& options) {
  const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
  std::vector<glm::dmat4> views;
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
    for (const double sign : {1.0, -1.0}) {
      const glm::dvec3 up(0, axis.y == 0 ? 1 : 0, axis.y == 0 ? 0 : 1);
      views.push_back(viewLooking(position, sign * axis, !options.cubeFaces ? up : axis.y == 0 ? -up : sign * up));
    }
  fitPyramids(light, geometry, views, 1, options);
}

} // namespace

std::vector<std::string> fitShadowViews(tyndall::Light& light, const Scene& scene,
                                        const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
                                        const ShadowOptions& options) {
  light.shadow.views.clear();
  light.shadow.clipDepth = options.clipDepth;
  const WorldGeometry geometry = blockingGeometry(scene, worldFromNode, options.seconds);
  if (geometry.triangles.empty()) return {};
  if (light.kind == tyndall::LightKind::Spot) return fitSpot(light, geometry, options);
  if (light.kind == tyndall::LightKind::Point)
    fitPoint(light, geometry, options);
  else
    fitDirectional(light, geometry, camera, options);
  return {};
}

} // namespace host
