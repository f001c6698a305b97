#include "Scenery.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

struct Box {
  glm::dvec3 low, high;
};

constexpr double kGlassHeight = 5;

const std::vector<Box>& standing() {
  static const std::vector<Box> all = [] {
    std::vector<Box> list = {{{-30, -1, -30}, {30, 0, 30}}, {{-3, 0, -9}, {3, 3, -8.5}}};
    for (const double x : {-2.5, 0.8, 3.1})
      list.push_back({{x - 0.3, 0, -6.3}, {x + 0.3, 4, -5.7}});
    for (int i = -2; i < 2; ++i)
      list.push_back({{2.4 * i + 0.3, 6, -10}, {2.4 * i + 1.7, 6.3, 6}});
    return list;
  }();
  return all;
}

/// A ray in units of its direction.
double enterBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& from, const glm::dvec3& along) {
  const glm::dvec3 a = (low - from) / along, b = (high - from) / along;
  const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
  const double t = std::max({enter.x, enter.y, enter.z});
  return t > 0 && t <= std::min({leave.x, leave.y, leave.z}) ? t : kInfinity;
}

class Caster {
public:
  explicit Caster(const std::vector<glm::dmat4>& cubes) {
    for (const glm::dmat4& cube : cubes)
      inverses_.push_back(glm::inverse(cube));
  }
  double distance(const glm::dvec3& origin, const glm::dvec3& direction) const {
    double nearest = kInfinity;
    for (const Box& box : standing())
      nearest = std::min(nearest, enterBox(box.low, box.high, origin, direction));
    for (const glm::dmat4& inverse : inverses_)
      nearest = std::min(nearest, enterBox(glm::dvec3(-1), glm::dvec3(1), glm::dvec3(inverse * glm::dvec4(origin, 1)),
                                           glm::dvec3(inverse * glm::dvec4(direction, 0))));
    return nearest;
  }

private:
  std::vector<glm::dmat4> inverses_;
};

struct Ray {
  glm::dvec3 origin, direction;
};

/// From the near plane through another one between the planes, which is finite where the far plane is not.
Ray rayThrough(const glm::dmat4& worldFromClip, const glm::dvec2& ndc, double nearZ, double betweenZ) {
  const glm::dvec4 a = worldFromClip * glm::dvec4(ndc, nearZ, 1), b = worldFromClip * glm::dvec4(ndc, betweenZ, 1);
  const glm::dvec3 origin = glm::dvec3(a) / a.w;
  return {origin, glm::dvec3(b) / b.w - origin};
}

double windowDepth(const glm::dmat4& clipFromWorld, const glm::dvec3& point, ClipDepth clipDepth) {
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
  const double z = clip.z / clip.w;
  return clipDepth == ClipDepth::ZeroToOne ? z : 0.5 + 0.5 * z;
}

glm::dvec2 texelCentre(int x, int y, int width, int height) {
  return 2.0 * (glm::dvec2(x, y) + 0.5) / glm::dvec2(width, height) - 1.0;
}

// What two depths swapped come to.
glm::dmat4 reversal(bool zeroToOne) {
  glm::dmat4 flip(1);
  flip[2][2] = -1;
  flip[3][2] = zeroToOne ? 1 : 0;
  return flip;
}

glm::dmat4 projectionOf(const CameraState& state, double aspect) {
  constexpr double kNear = 0.2, kFar = 40;
  const double height = 6 * state.size, fov = 2 * std::atan(state.size);
  glm::dmat4 projection;
  if (state.infinite) {
    projection = glm::dmat4(0);
    projection[0][0] = 1 / (state.size * aspect);
    projection[1][1] = 1 / state.size;
    projection[2][3] = -1;
    projection[3][2] = kNear;
    return projection;
  }
  if (state.orthographic)
    projection = state.zeroToOne ? glm::orthoRH_ZO(-height * aspect, height * aspect, -height, height, kNear, kFar)
                                 : glm::orthoRH_NO(-height * aspect, height * aspect, -height, height, kNear, kFar);
  else
    projection = state.zeroToOne ? glm::perspectiveRH_ZO(fov, aspect, kNear, kFar)
                                 : glm::perspectiveRH_NO(fov, aspect, kNear, kFar);
  return state.reversed ? reversal(state.zeroToOne) * projection : projection;
}

glm::dvec3 downwards(double turn) { return glm::normalize(glm::dvec3(0.3 * std::sin(turn), -1, 0.3 * std::cos(turn))); }

void addSunViews(Light& light, int cascades) {
  const glm::dvec3 along(light.direction[0], light.direction[1], light.direction[2]);
  for (int i = 0; i < cascades; ++i) {
    const double half = 12 / std::pow(2.0, cascades - 1 - i);
    const glm::dvec3 middle(0, 1, -3);
    const glm::dmat4 view = glm::lookAt(middle - 20.0 * along, middle, glm::dvec3(0, 0, 1));
    light.shadow.views.push_back({fromGlm(glm::orthoRH_NO(-half, half, -half, half, 1.0, 45.0) * view)});
  }
}

void addLampViews(Light& light) {
  const glm::dvec3 place(light.position[0], light.position[1], light.position[2]);
  if (light.kind == LightKind::Spot) {
    const glm::dvec3 along(light.direction[0], light.direction[1], light.direction[2]);
    const glm::dmat4 view = glm::lookAt(place, place + along, glm::dvec3(0, 0, 1));
    light.shadow.views = {{fromGlm(glm::perspectiveRH_NO(2 * light.outerConeAngle, 1.0, 0.2, 30.0) * view)}};
    return;
  }
  for (const int axis : {0, 1, 2})
    for (const double sign : {1.0, -1.0}) {
      glm::dvec3 along(0), up(0);
      along[axis] = sign;
      up[(axis + 1) % 3] = 1;
      const glm::dmat4 view = glm::lookAt(place, place + along, up);
      light.shadow.views.push_back({fromGlm(glm::perspectiveRH_NO(glm::half_pi<double>(), 1.0, 0.2, 30.0) * view)});
    }
}

} // namespace

glm::dmat4 poseOf(const MoverState& mover) {
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), mover.place);
  return glm::scale(glm::rotate(moved, mover.angle, glm::normalize(glm::dvec3(1, 2, 3))), mover.size);
}

std::vector<glm::dmat4> cubesOf(const ScriptState& state) {
  std::vector<glm::dmat4> cubes;
  for (const MoverState& mover : state.movers)
    if (mover.present) cubes.push_back(glm::scale(poseOf(mover), glm::dvec3(mover.mesh ? mover.shape : 1)));
  return cubes;
}

Camera cameraOf(const CameraState& state, const std::array<double, 2>& jitter, int width, int height) {
  const glm::dvec3 forward(std::sin(state.turn) * std::cos(state.tilt), std::sin(state.tilt),
                           -std::cos(state.turn) * std::cos(state.tilt));
  Camera camera;
  camera.viewFromWorld = fromGlm(glm::lookAt(state.place, state.place + forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 ndc(2 * jitter[0] / width, 2 * jitter[1] / height, 0);
  const glm::dmat4 projection = projectionOf(state, static_cast<double>(width) / height);
  camera.clipFromView = fromGlm(glm::translate(glm::dmat4(1), ndc) * projection);
  camera.clipDepth = state.zeroToOne ? ClipDepth::ZeroToOne : ClipDepth::NegativeOneToOne;
  camera.jitter = jitter;
  return camera;
}

Light lightOf(const LightState& state) {
  Light light;
  light.kind = state.kind;
  light.colour = state.colour;
  light.litOutsideViews = state.litOutside;
  const bool sun = state.kind == LightKind::Directional;
  for (float& channel : light.colour)
    channel *= sun ? 1.0F : 20.0F;
  const glm::dvec3 along = downwards(state.turn);
  light.direction = {along.x, along.y, along.z};
  light.position = {1.5 * std::sin(3 * state.turn), 4.6, -3.5};
  light.outerConeAngle = 0.9;
  light.innerConeAngle = 0.5;
  if (!state.hasMap) return light;
  if (sun)
    addSunViews(light, state.cascades);
  else
    addLampViews(light);
  return light;
}

std::vector<float> castDepth(const std::vector<glm::dmat4>& cubes, const Mat4& clipFromWorld, ClipDepth clipDepth,
                             bool reversed, int width, int height) {
  const Caster caster(cubes);
  const glm::dmat4 clip = toGlm(clipFromWorld), inverse = glm::inverse(clip);
  const double low = clipDepth == ClipDepth::ZeroToOne ? 0 : -1;
  std::vector<float> depths;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Ray ray = rayThrough(inverse, texelCentre(x, y, width, height), reversed ? 1 : low, 0.5 * (1 + low));
      const double t = caster.distance(ray.origin, ray.direction), sky = reversed ? 0 : 1;
      const double depth = std::isinf(t) ? sky : windowDepth(clip, ray.origin + t * ray.direction, clipDepth);
      depths.push_back(static_cast<float>(std::clamp(depth, 0.0, 1.0)));
    }
  return depths;
}

GlassImage castGlass(const Mat4& clipFromWorld, int size) {
  const glm::dmat4 clip = toGlm(clipFromWorld), inverse = glm::inverse(clip);
  GlassImage image;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const Ray ray = rayThrough(inverse, texelCentre(x, y, size, size), -1, 0);
      const double t = (kGlassHeight - ray.origin.y) / ray.direction.y;
      const glm::dvec3 point = ray.origin + t * ray.direction;
      const double depth = t > 0 ? windowDepth(clip, point, ClipDepth::NegativeOneToOne) : 2;
      const bool glazed = depth > 0 && depth < 1;
      image.depth.push_back(glazed ? static_cast<float>(depth) : 1.0F);
      const int pane = glazed ? static_cast<int>(std::floor(point.x / 2) + 3 * std::floor(point.z / 2)) + 300 : 0;
      for (int channel = 0; channel < 3; ++channel)
        image.colour.push_back(glazed ? 0.2F + 0.2F * static_cast<float>((pane + channel) % 5) : 1.0F);
    }
  return image;
}

glm::dmat4 toGlm(const Mat4& matrix) {
  glm::dmat4 result;
  for (int i = 0; i < 16; ++i)
    result[i / 4][i % 4] = matrix[static_cast<std::size_t>(i)];
  return result;
}

Mat4 fromGlm(const glm::dmat4& matrix) {
  Mat4 result{};
  for (int i = 0; i < 16; ++i)
    result[static_cast<std::size_t>(i)] = matrix[i / 4][i % 4];
  return result;
}

} // namespace stress
