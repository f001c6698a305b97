#include "gl/ClipConvention.h"

#include "scene/Error.h"

#include <glm/gtc/matrix_access.hpp>

namespace host {

// Along the view axis depth is (m22 z + m23) / (m32 z + m33), with the derivative by z
// (m22 m33 - m23 m32) / (m32 z + m33)^2. Distance is -z: where the derivative is positive, depth is reversed.
ClipConvention clipConventionOf(const tyndall::Camera& camera) {
  const glm::dmat4 clipFromView = fromMat4(camera.clipFromView); // glm: [column][row]
  const double slope = clipFromView[2][2] * clipFromView[3][3] - clipFromView[3][2] * clipFromView[2][3];
  return {slope > 0, camera.clipDepth};
}

// A directional light's depth is affine and rises or falls along the light. The centre of a perspective view is the
// light, where w = 0: at distance t on a ray from there depth is const + (row z . centre) / (t dw/dt).
ClipConvention clipConventionOf(const tyndall::Light& light, const tyndall::ShadowView& view) {
  const glm::dvec4 depthRow = glm::row(fromMat4(view.clipFromWorld), 2);
  const glm::dvec3 direction(light.direction[0], light.direction[1], light.direction[2]);
  const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
  const bool reversed = light.kind == tyndall::LightKind::Directional ? glm::dot(glm::dvec3(depthRow), direction) < 0
                                                                      : glm::dot(depthRow, glm::dvec4(position, 1)) > 0;
  return {reversed, light.shadow.clipDepth};
}

float farDepth(const ClipConvention& convention) { return convention.reversed ? 0.0F : 1.0F; }

GLenum nearerFunction(const ClipConvention& convention) { return convention.reversed ? GL_GREATER : GL_LESS; }

GLenum nearerOrEqualFunction(const ClipConvention& convention) { return convention.reversed ? GL_GEQUAL : GL_LEQUAL; }

void applyClipConvention(const ClipConvention& convention) {
  const bool zeroToOne = convention.clipDepth == tyndall::ClipDepth::ZeroToOne;
  if (gl().ClipControl) {
    gl().ClipControl(GL_LOWER_LEFT, zeroToOne ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  } else if (zeroToOne) {
    throw Error("clipDepth ZeroToOne: the context lacks glClipControl, which came with OpenGL 4.5");
  }
  gl().DepthRange(0, 1);
  gl().ClearDepth(farDepth(convention));
}

} // namespace host
