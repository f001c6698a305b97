#include "gl/Functions.h"

namespace tyndall::gl {

std::string Functions::load(void* (*loader)(const char*)) {
  std::string missing;
#define TYNDALL_GL_LOAD(result, function, arguments, state)                                                            \
  function = reinterpret_cast<result(TYNDALL_GLAPI*) arguments>(loader("gl" #function));
#define TYNDALL_GL_REQUIRE(result, function, arguments, state)                                                         \
  TYNDALL_GL_LOAD(result, function, arguments, state)                                                                  \
  if (!function && missing.empty()) missing = "gl" #function;
  TYNDALL_GL_REQUIRED(TYNDALL_GL_REQUIRE)
  TYNDALL_GL_OPTIONAL(TYNDALL_GL_LOAD)
#undef TYNDALL_GL_REQUIRE
#undef TYNDALL_GL_LOAD
  return missing;
}

} // namespace tyndall::gl
