#include "CheckValues.h"
#include "optics/EyeLight.h"
#include "optics/Jitter.h"
#include "optics/Matrices.h"
#include "tyndall/avsm.h"

namespace tyndall {

Status avsmDepth(const Light& light, int view, std::array<double, 4>& depth) {
  const auto refuse = [&](const std::string& rule) {
    return Status{StatusCode::InvalidFrame, "view is " + std::to_string(view) + ": " + rule};
  };
  if (view < 0 || view >= static_cast<int>(light.shadow.views.size()))
    return refuse("the light has " + std::to_string(light.shadow.views.size()) + " shadow views");
  const bool directional = light.kind == LightKind::Directional;
  const glm::dvec3 from = optics::toGlm(directional ? light.direction : light.position);
  if (!(glm::length(from) < kInfinity)) return refuse("the light's direction or position must be finite");
  if (directional && from == glm::dvec3(0)) return refuse("the light's direction must have a length");
  const glm::dmat4 matrix = optics::toGlm(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld);
  if (!optics::isInvertible(matrix)) return refuse("its matrix must be invertible");
  const optics::DepthPlane plane = optics::linearDepth(light, view);
  if (!plane.exists) return refuse("its far plane must not be at infinity");
  depth = {plane.coefficients.x, plane.coefficients.y, plane.coefficients.z, plane.coefficients.w};
  return {};
}

Status eyeLight(const Camera& camera, const Rectangle& viewport, double nearDistance, double farDistance,
                Light& light) {
  if (Status s = checkViewport(viewport); !s) return s;
  if (Status s = checkCamera(camera); !s) return s;
  if (Status s = checkEyePlanes(camera, nearDistance, farDistance); !s) return s;
  light = optics::eyeLight(optics::steady(camera, viewport), nearDistance, farDistance);
  return {};
}

} // namespace tyndall
