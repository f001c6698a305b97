// Fills a table of GL functions, and says in words why a context will not do.
#pragma once

#include "gl/Functions.h"

#include <tyndall/tyndall.h>

namespace tyndall {

/// `version` is 10 * major + minor of what is needed, `what` needs it.
Status loadFunctions(gl::Functions& gl, GlLoader loader, int version, const std::string& what);

} // namespace tyndall
