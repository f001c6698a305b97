// Projection and view matrices of the host, in double. View space looks along -z with y up, as in GL and glTF.
#pragma once

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace host {

/// How depth is stored: standard depth grows away from the eye, reversed depth shrinks to its least value at the far
/// plane.
struct ClipConvention {
  bool reversed = false;
  tyndall::ClipDepth clipDepth = tyndall::ClipDepth::NegativeOneToOne;
};

/// NDC z of the near plane and of the far plane.
double ndcNear(const ClipConvention& convention);
double ndcFar(const ClipConvention& convention);

/// halfWidth and halfHeight: the tangents of the half angles. farPlane may be infinite. 0 < nearPlane < farPlane.
glm::dmat4 perspective(double halfWidth, double halfHeight, double nearPlane, double farPlane,
                       const ClipConvention& convention);

/// A box around the view axis. The planes are distances along -z, of any sign; nearPlane < farPlane.
glm::dmat4 orthographic(double halfWidth, double halfHeight, double nearPlane, double farPlane,
                        const ClipConvention& convention);

/// Looks from eye along direction (not 0), with up (any length) upwards where it is not parallel to direction.
glm::dmat4 viewLooking(const glm::dvec3& eye, const glm::dvec3& direction, const glm::dvec3& up = {0, 1, 0});

tyndall::Mat4 toMat4(const glm::dmat4& matrix);
glm::dmat4 fromMat4(const tyndall::Mat4& matrix);

} // namespace host
