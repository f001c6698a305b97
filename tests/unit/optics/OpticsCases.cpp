#include "OpticsCases.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace tests {

using glm::dmat4;
using glm::dvec3;
using tyndall::LightKind;

dvec3 Random::direction() {
  const double z = within(-1, 1), angle = within(-glm::pi<double>(), glm::pi<double>()), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

std::vector<Projection> projections(double scale) {
  std::vector<Projection> all;
  for (const host::ClipConvention& c : kConventions) {
    const std::string name = std::string(c.reversed ? "reversed, " : "standard, ") +
                             (c.clipDepth == tyndall::ClipDepth::ZeroToOne ? "0 to 1, " : "-1 to 1, ");
    const double near = 0.1 * scale, far = 60 * scale;
    const dmat4 finite = host::perspective(0.8, 0.5, near, far, c);
    all.push_back({name + "perspective", c, false, near, far, finite});
    all.push_back({name + "infinite", c, false, near, tyndall::kInfinity,
                   host::perspective(0.8, 0.5, near, tyndall::kInfinity, c)});
    all.push_back({name + "off centre", c, false, near, far, glm::translate(dmat4(1), dvec3(0.6, -0.3, 0)) * finite});
    all.push_back({name + "orthographic", c, true, near, far, host::orthographic(8 * scale, 5 * scale, near, far, c)});
  }
  return all;
}

tyndall::Camera cameraOf(const Projection& projection, const dvec3& eye, const dvec3& direction, const dvec3& up) {
  return {host::toMat4(host::viewLooking(eye, direction, up)), host::toMat4(projection.clipFromView),
          projection.convention.clipDepth};
}

tyndall::Frame frameOf(const tyndall::Camera& camera, int width, int height) {
  tyndall::Frame frame;
  frame.viewport.width = width;
  frame.viewport.height = height;
  frame.camera = camera;
  frame.medium.constituents = {{{0.04F, 0.06F, 0.1F}, tyndall::Phase::HenyeyGreenstein, 0.4F}};
  frame.medium.absorption = {0.01F, 0.02F, 0};
  return frame;
}

Seen seenAt(const tyndall::Frame& frame, const dvec3& point) {
  const dmat4 clipFromWorld = host::fromMat4(frame.camera.clipFromView) * host::fromMat4(frame.camera.viewFromWorld);
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
  const dvec3 ndc = dvec3(clip) / clip.w;
  const bool half = frame.camera.clipDepth == tyndall::ClipDepth::NegativeOneToOne;
  return {{(0.5 * ndc.x + 0.5) * frame.viewport.width, (0.5 * ndc.y + 0.5) * frame.viewport.height},
          half ? 0.5 * ndc.z + 0.5 : ndc.z,
          clip.w};
}

tyndall::Light sun(const dvec3& direction) {
  tyndall::Light light;
  light.direction = vec(direction);
  return light;
}

tyndall::Light lamp(const dvec3& position) {
  tyndall::Light light;
  light.kind = LightKind::Point;
  light.position = vec(position);
  return light;
}

tyndall::Light spot(const dvec3& position, const dvec3& direction, double outerConeAngle) {
  tyndall::Light light = lamp(position);
  light.kind = LightKind::Spot;
  light.direction = vec(direction);
  light.outerConeAngle = outerConeAngle;
  light.innerConeAngle = 0.5 * outerConeAngle;
  return light;
}

void addViews(tyndall::Light& light, const host::ClipConvention& convention, const dvec3& middle, double size) {
  light.shadow.texture = 1; // never looked at
  light.shadow.clipDepth = convention.clipDepth;
  light.shadow.views.clear();
  const auto add = [&](const dmat4& clipFromView, const dmat4& viewFromWorld) {
    light.shadow.views.push_back(
        {host::toMat4(clipFromView * viewFromWorld), static_cast<int>(light.shadow.views.size())});
  };
  switch (light.kind) {
  case LightKind::Directional:
    for (const double half : {0.3 * size, size})
      add(host::orthographic(half, half, -size, size, convention), host::viewLooking(middle, vec(light.direction)));
    break;
  case LightKind::Spot: {
    const double tangent = std::tan(std::min(light.outerConeAngle, 1.4));
    add(host::perspective(tangent, tangent, 0.01 * size, 3 * size, convention),
        host::viewLooking(vec(light.position), vec(light.direction)));
    break;
  }
  case LightKind::Point:
    for (int face = 0; face < 6; ++face) {
      dvec3 axis(0);
      axis[face / 2] = face % 2 == 0 ? 1 : -1;
      add(host::perspective(1, 1, 0.01 * size, 3 * size, convention), host::viewLooking(vec(light.position), axis));
    }
    break;
  }
}

dvec3 vec(const tyndall::Vec3& v) { return {v[0], v[1], v[2]}; }
tyndall::Vec3 vec(const dvec3& v) { return {v.x, v.y, v.z}; }

dmat4 Placement::matrix() const {
  dmat4 m(scale * rotation);
  m[3] = glm::dvec4(offset, 1);
  return m;
}

// Views keep their clip space. Lengths along z go with the scale, so the clip matrices take it, and view space too.
tyndall::Frame placed(tyndall::Frame frame, const Placement& p) {
  const dmat4 back = glm::inverse(p.matrix()), scale = glm::scale(dmat4(1), dvec3(p.scale));
  frame.camera.viewFromWorld = host::toMat4(scale * host::fromMat4(frame.camera.viewFromWorld) * back);
  frame.camera.clipFromView = host::toMat4(host::fromMat4(frame.camera.clipFromView) * glm::inverse(scale));
  for (tyndall::Constituent& constituent : frame.medium.constituents)
    for (float& value : constituent.scattering)
      value /= static_cast<float>(p.scale);
  for (float& value : frame.medium.absorption)
    value /= static_cast<float>(p.scale);
  frame.medium.farDistance *= p.scale;
  for (tyndall::Light& light : frame.lights) {
    light.position = vec(dvec3(p.matrix() * glm::dvec4(vec(light.position), 1)));
    light.direction = vec(p.rotation * vec(light.direction));
    light.range *= p.scale;
    for (tyndall::ShadowView& view : light.shadow.views)
      view.clipFromWorld = host::toMat4(host::fromMat4(view.clipFromWorld) * back);
  }
  for (tyndall::MovingObject& object : frame.objects)
    for (tyndall::Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
      *pose = host::toMat4(p.matrix() * host::fromMat4(*pose));
  return frame;
}

glm::dmat3 turned(Random& random) {
  const dvec3 axis = random.direction();
  return glm::dmat3(glm::rotate(dmat4(1), random.within(0, 2 * glm::pi<double>()), axis));
}

} // namespace tests
