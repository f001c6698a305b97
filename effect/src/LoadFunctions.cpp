#include "LoadFunctions.h"

#include "ContextWatch.h"
#include "gl/Enums.h"

#include <set>

namespace tyndall {

namespace {

std::set<std::string> extensionsOf(const gl::Functions& gl) {
  gl::Int count = 0;
  gl.GetIntegerv(gl::NUM_EXTENSIONS, &count);
  std::set<std::string> names;
  for (gl::Int i = 0; i < count; ++i)
    if (const auto* name = gl.GetStringi(gl::EXTENSIONS, static_cast<gl::Uint>(i)))
      names.insert(reinterpret_cast<const char*>(name));
  return names;
}

// What is of a later version than the context's, unless an extension brings it.
void settleExtensions(gl::Functions& gl) {
  const std::set<std::string> extensions = extensionsOf(gl);
  const auto has = [&](int version, const char* extension) {
    return gl.version >= version || extensions.count(extension) != 0;
  };
  if (!has(45, "GL_ARB_clip_control")) gl.ClipControl = nullptr;
  if (!has(41, "GL_ARB_get_program_binary")) gl.GetProgramBinary = nullptr;
  if (!has(43, "GL_KHR_debug")) gl.ObjectLabel = nullptr;
  gl.parallelCompile = extensions.count("GL_KHR_parallel_shader_compile") != 0 ||
                       extensions.count("GL_ARB_parallel_shader_compile") != 0;
  gl.stencilTexturing = has(43, "GL_ARB_stencil_texturing");
  if (!has(45, "GL_KHR_robustness"))
    gl.GetGraphicsResetStatus = has(45, "GL_ARB_robustness") ? gl.GetGraphicsResetStatusARB : nullptr;
  if (!has(44, "GL_ARB_multi_bind")) gl.BindTextures = nullptr;
  if (!gl.BindTextures) gl.BindSamplers = nullptr;
  if (extensions.count("GL_EXT_stencil_two_side") == 0) gl.ActiveStencilFaceEXT = nullptr;
  gl.debugOutput = has(43, "GL_KHR_debug") && gl.PushDebugGroup && gl.PopDebugGroup;
  gl.GetIntegerv(gl::MAX_CLIP_DISTANCES, &gl.clipDistances);
  gl::Int profile = 0;
  gl.GetIntegerv(gl::CONTEXT_PROFILE_MASK, &profile);
  gl.compatibility = (static_cast<gl::Bitfield>(profile) & gl::CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
  // Mesa tells a texture's target in the core profile only.
  if (!has(45, "GL_ARB_direct_state_access") || gl.compatibility) gl.GetTextureParameteriv = nullptr;
}

} // namespace

Status loadFunctions(gl::Functions& gl, GlLoader loader, int version, const std::string& what) {
  std::string missing = gl.load(loader);
  if (!gl.GetString) return {StatusCode::NoContext, "no GL context is current on this thread"};
  if (!gl.GetString(gl::VERSION)) return ContextWatch(gl).check();
  const std::string text = reinterpret_cast<const char*>(gl.GetString(gl::VERSION));
  if (!gl.GetIntegerv) return {StatusCode::ContextTooOld, "the loader knows no " + missing};
  gl::Int major = 0, minor = 0;
  gl.GetIntegerv(gl::MAJOR_VERSION, &major); // an error, and 0, before OpenGL 3.0
  gl.GetIntegerv(gl::MINOR_VERSION, &minor);
  gl.version = 10 * major + minor;
  const std::string needed = "OpenGL " + std::to_string(version / 10) + "." + std::to_string(version % 10);
  if (gl.version < version || text.rfind("OpenGL ES", 0) == 0)
    return {StatusCode::ContextTooOld,
            "the context is \"" + text + "\": " + needed + " core or later is needed" + what};
  if (missing.empty()) {
    settleExtensions(gl);
    if (gl.compatibility) missing = gl.loadLegacy(loader);
  }
  if (!missing.empty())
    return {StatusCode::ContextTooOld, "the context is \"" + text + "\" but the loader knows no " + missing};
  return ContextWatch(gl).check();
}

} // namespace tyndall
