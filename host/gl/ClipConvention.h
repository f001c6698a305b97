// Which way depth runs, read off a projection, and the GL state that follows from it.
#pragma once

#include "gl/Gl.h"
#include "scene/Projection.h"

#include <tyndall/tyndall.h>

namespace host {

ClipConvention clipConventionOf(const tyndall::Camera& camera);

/// Of one view of a light's shadow map.
ClipConvention clipConventionOf(const tyndall::Light& light, const tyndall::ShadowView& view);

/// Depth buffer value of the far plane.
float farDepth(const ClipConvention& convention);

/// Depth functions that let the nearer fragment pass.
GLenum nearerFunction(const ClipConvention& convention);
GLenum nearerOrEqualFunction(const ClipConvention& convention);

/// Sets the clip control, the depth range and the clear depth. Throws host::Error where the convention needs a clip
/// control that the context lacks.
void applyClipConvention(const ClipConvention& convention);

} // namespace host
