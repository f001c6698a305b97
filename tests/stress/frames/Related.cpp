// What must leave a picture as it is, or change it in a known way.
#include "Case.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

/// Pixel (x, y) of the related picture shows `from(x, y)` of the other one.
template <typename Values, typename From>
Values rearranged(const Values& values, int width, int height, int oldWidth, const From& from) {
  Values result;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::ivec2 old = from(x, y);
      result.push_back(values[static_cast<std::size_t>(old.y) * static_cast<std::size_t>(oldWidth) +
                              static_cast<std::size_t>(old.x)]);
    }
  return result;
}

/// Where a pixel of a mirrored or rolled picture of this size comes from.
glm::ivec2 origin(Relation relation, int width, int height, int x, int y) {
  static_cast<void>(height);
  if (relation == Relation::Mirror) return {width - 1 - x, y};
  return {y, width - 1 - x}; // NDC (x, y) -> (-y, x), so back (x, y) -> (y, -x)
}

void turn(Case& made, Relation relation) {
  Frame& frame = made.frame;
  const int oldWidth = frame.viewport.width;
  glm::dmat4 turned(1);
  if (relation == Relation::Mirror) {
    turned[0][0] = -1;
  } else {
    turned[0] = {0, 1, 0, 0};
    turned[1] = {-1, 0, 0, 0};
    std::swap(frame.viewport.width, frame.viewport.height);
  }
  frame.camera.clipFromView = tests::toMat4(turned * reference::toMat4(frame.camera.clipFromView));
  const int width = frame.viewport.width, height = frame.viewport.height;
  const auto from = [&](int x, int y) { return origin(relation, width, height, x, y); };
  made.distances = rearranged(made.distances, width, height, oldWidth, from);
  made.depth = rearranged(made.depth, width, height, oldWidth, from);
  made.isOdd = rearranged(made.isOdd, width, height, oldWidth, from);
  const int size = made.eyeCurves.size;
  made.eyeCurves.curves = rearranged(made.eyeCurves.curves, size, size, size,
                                     [&](int x, int y) { return origin(relation, size, size, x, y); });
}

/// The most precise depth there is, of the distances that the old one holds.
bool encodeAnew(Case& made) {
  tests::DepthConvention& convention = made.lens.convention;
  if (made.depthForm != DepthForm::Float || convention.orthographic) return false;
  const Rectangle& viewport = made.frame.viewport;
  const glm::dmat4 viewFromClip = glm::inverse(reference::toMat4(made.frame.camera.clipFromView));
  convention.reversed = convention.infinite = true;
  convention.clipDepth = ClipDepth::ZeroToOne;
  convention.near = 0.01;
  for (std::size_t i = 0; i < made.depth.size(); ++i) {
    if (made.isOdd[i]) continue;
    const double ndc = reference::ndcFromDepth(made.frame.camera.clipDepth, made.depth[i]);
    const glm::dvec4 point = viewFromClip * glm::dvec4(0, 0, ndc, 1);
    const double distance = std::isinf(made.distances[i]) ? kInfinity : -point.z / point.w / made.worldScale;
    if (!(distance > convention.near)) return false;
    made.distances[i] = distance;
    made.depth[i] = convention.windowDepth(distance);
  }
  made.frame.camera.clipDepth = convention.clipDepth;
  const glm::dmat4 clip =
      reference::toMat4(made.lens.clipFromView(static_cast<double>(viewport.width) / viewport.height));
  made.frame.camera.clipFromView = tests::toMat4(clip * glm::scale(glm::dmat4(1), glm::dvec3(1 / made.worldScale)));
  return true;
}

void scaleLights(Frame& frame, float factor) {
  for (Light& light : frame.lights)
    for (float& channel : light.colour)
      channel *= factor;
}

void scaleAmbient(Ambient& ambient, float factor) {
  for (float& channel : ambient.radiance)
    channel *= factor;
  for (Rgb& harmonic : ambient.harmonics)
    for (float& channel : harmonic)
      channel *= factor;
}

bool halveMedia(Medium& medium) {
  if (medium.constituents.empty() || medium.constituents.size() > kMaxConstituents / 2) return false;
  for (Constituent& constituent : medium.constituents)
    for (float& sigma : constituent.scattering)
      sigma *= 0.5F;
  const std::vector<Constituent> half = medium.constituents;
  medium.constituents.insert(medium.constituents.end(), half.begin(), half.end());
  return true;
}

} // namespace

std::optional<Case> related(const Case& made, Relation relation) {
  Case other = made;
  Random random(made.seed ^ 0x5eed, Axis::Relation);
  switch (relation) {
  case Relation::Scale:
    other.worldScale *= 256;
    tests::transformWorld(other.frame, 256, glm::dvec3(0));
    return other;
  case Relation::Offset:
    tests::transformWorld(other.frame, 1, made.worldScale * random.logUniform(1, 1e5) * random.direction());
    return other;
  case Relation::Mirror:
  case Relation::Roll:
    turn(other, relation);
    return other;
  case Relation::Depth:
    if (!encodeAnew(other)) return {};
    return other;
  case Relation::DoubledLight:
    scaleLights(other.frame, 2);
    scaleAmbient(other.frame.ambient, 2);
    return other;
  case Relation::HalfMedia:
    if (!halveMedia(other.frame.medium)) return {};
    return other;
  case Relation::LightOrder:
    if (made.frame.lights.size() < 2) return {};
    std::reverse(other.frame.lights.begin(), other.frame.lights.end());
    std::reverse(other.maps.begin(), other.maps.end());
    return other;
  case Relation::SplitLight:
    scaleLights(other.frame, 0.5F);
    for (std::size_t i = 0; i < made.frame.lights.size(); ++i)
      other.frame.lights.push_back(other.frame.lights[i]);
    other.maps.insert(other.maps.end(), made.maps.begin(), made.maps.end());
    return other;
  }
  return {};
}

reference::Image relatedPicture(const reference::Image& picture, Relation relation) {
  reference::Image result = picture;
  if (relation == Relation::DoubledLight)
    for (double& value : result.rgb)
      value *= 2;
  if (relation != Relation::Mirror && relation != Relation::Roll) return result;
  if (relation == Relation::Roll) std::swap(result.width, result.height);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const glm::ivec2 old = origin(relation, result.width, result.height, x, y);
      result.set(x, y, picture.at(old.x, old.y));
    }
  return result;
}

} // namespace stress
