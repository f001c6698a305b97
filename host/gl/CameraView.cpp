#include "gl/CameraView.h"

#include "scene/Error.h"

#include <glm/gtc/matrix_transform.hpp>
#include <tyndall/avsm.h>

namespace host {

CameraView::CameraView(const tyndall::Camera& camera)
    : clipFromView(fromMat4(camera.clipFromView)), viewFromWorld(fromMat4(camera.viewFromWorld)),
      clipFromWorld(clipFromView * viewFromWorld), worldFromView(glm::inverse(viewFromWorld)), eye(worldFromView[3]),
      perspective(clipFromView[2][3] != 0), convention(clipConventionOf(camera)) {}

glm::vec4 CameraView::viewerFrom(const glm::dvec3& origin) const {
  return perspective ? glm::vec4(eye - origin, 1) : glm::vec4(glm::vec3(worldFromView[2]), 0);
}

CaptureView::CaptureView(const tyndall::Light& source, int view, int texels)
    : clipFromWorld(fromMat4(source.shadow.views[static_cast<std::size_t>(view)].clipFromWorld)), layer(view),
      size(texels) {
  std::array<double, 4> depth{};
  const tyndall::Status status = tyndall::avsmDepth(source, view, depth);
  if (!status) {
    throw Error("capture from a light: " + status.message);
  }
  depthPlane = {depth[0], depth[1], depth[2], depth[3]};
  const glm::dvec3 direction(source.direction[0], source.direction[1], source.direction[2]);
  light = source.kind == tyndall::LightKind::Directional
              ? glm::dvec4(-glm::normalize(direction), 0)
              : glm::dvec4(source.position[0], source.position[1], source.position[2], 1);
}

glm::dmat4 translation(const glm::dvec3& by) { return glm::translate(glm::dmat4(1), by); }

} // namespace host
