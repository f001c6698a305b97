// The GL functions of the context that is current in this thread.
#pragma once

#include <glad/gl.h>

namespace host {

/// Throws host::Error if no host context is current. Used as gl().BindTexture(...).
const GladGLContext& gl();

/// Whether that context is of OpenGL ES, which lacks some of them.
bool isEmbedded();

} // namespace host
