#include "gl/Functions.h"

#include <tyndall/tyndall.h>

namespace tyndall::gl {

#define TYNDALL_GL_LOAD(result, function, arguments, state)                                                            \
  function = reinterpret_cast<result(TYNDALL_GLAPI*) arguments>(loader("gl" #function));
#define TYNDALL_GL_REQUIRE(result, function, arguments, state)                                                         \
  TYNDALL_GL_LOAD(result, function, arguments, state)                                                                  \
  if (!function && missing.empty()) missing = "gl" #function;

std::string Functions::load(GlLoader loader) {
  std::string missing;
  TYNDALL_GL_REQUIRED(TYNDALL_GL_REQUIRE)
  TYNDALL_GL_OPTIONAL(TYNDALL_GL_LOAD)
  return missing;
}

std::string Functions::loadOwn(GlLoader loader) {
  std::string missing;
  if (language == Language::Essl) {
    TYNDALL_GL_EMBEDDED(TYNDALL_GL_REQUIRE)
  } else {
    TYNDALL_GL_DESKTOP(TYNDALL_GL_REQUIRE)
  }
  if (compatibility) {
    TYNDALL_GL_LEGACY(TYNDALL_GL_REQUIRE)
  }
  return missing;
}

#undef TYNDALL_GL_REQUIRE
#undef TYNDALL_GL_LOAD

} // namespace tyndall::gl
