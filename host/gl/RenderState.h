// The GL state that the renderers start from.
#pragma once

namespace host {

/// Filled polygons of both sides, all channels written, no test but depth (whose function is the caller's), no
/// blending.
void resetRenderState();

} // namespace host
