#include "LoadFunctions.h"

#include "ContextWatch.h"
#include "gl/Enums.h"

#include <set>
#include <type_traits>

namespace tyndall {

namespace {

constexpr int kLeastVersion = 33; // of an effect

std::set<std::string> extensionsOf(const gl::Functions& gl) {
  gl::Int count = 0;
  gl.GetIntegerv(gl::NUM_EXTENSIONS, &count);
  std::set<std::string> names;
  for (gl::Int i = 0; i < count; ++i)
    if (const auto* name = gl.GetStringi(gl::EXTENSIONS, static_cast<gl::Uint>(i)))
      names.insert(reinterpret_cast<const char*>(name));
  return names;
}

class Context {
public:
  Context(gl::Functions& gl, const std::string& version) : gl_(gl), version_(version), extensions_(extensionsOf(gl)) {}

  bool has(const char* extension) const { return extensions_.count(extension) != 0; }
  /// A desktop context of that version, or any with the extension.
  bool has(int version, const char* extension) const {
    return (!isEmbedded() && gl_.version >= version) || has(extension);
  }
  bool isEmbedded() const { return gl_.language == gl::Language::Essl; }

  void settle(GlLoader loader) {
    if (isEmbedded())
      settleEmbedded(loader);
    else
      settleDesktop();
    gl_.parallelCompile = has("GL_KHR_parallel_shader_compile") || has("GL_ARB_parallel_shader_compile");
    gl_.debugOutput = gl_.debugOutput && gl_.PushDebugGroup && gl_.PopDebugGroup;
    gl_.indexedBlending = gl_.indexedBlending && gl_.BlendFuncSeparatei && gl_.BlendEquationSeparatei;
    gl_.viewportArrays = gl_.viewportArrays && gl_.ViewportIndexedf && gl_.ScissorIndexed && gl_.GetFloati_v;
    if (isEmbedded() ? has("GL_EXT_clip_cull_distance") : true)
      gl_.GetIntegerv(gl::MAX_CLIP_DISTANCES, &gl_.clipDistances);
  }

private:
  // It tells a texture's target in the core profile only.
  bool isMesa() const { return version_.find("Mesa") != std::string::npos; }

  // What is of a later version than the context's, unless an extension brings it.
  void settleDesktop() {
    gl::Int profile = 0;
    gl_.GetIntegerv(gl::CONTEXT_PROFILE_MASK, &profile);
    gl_.compatibility = (static_cast<gl::Bitfield>(profile) & gl::CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
    gl_.indexedBlending = gl_.feedbackQuery = gl_.version >= 40;
    gl_.viewportArrays = gl_.version >= 41;
    gl_.cubeArrays = has(40, "GL_ARB_texture_cube_map_array");
    gl_.stencilTexturing = has(43, "GL_ARB_stencil_texturing");
    gl_.debugOutput = has(43, "GL_KHR_debug");
    gl_.normalised16 = gl_.countsSamples = gl_.timerQueries = gl_.dualSource = true;
    if (!has(45, "GL_ARB_clip_control")) gl_.ClipControl = nullptr;
    if (!has(41, "GL_ARB_get_program_binary")) gl_.GetProgramBinary = nullptr;
    if (!has(43, "GL_KHR_debug")) gl_.ObjectLabel = nullptr;
    if (!has(45, "GL_KHR_robustness"))
      gl_.GetGraphicsResetStatus = has(45, "GL_ARB_robustness") ? gl_.GetGraphicsResetStatusARB : nullptr;
    if (!has(45, "GL_ARB_direct_state_access") || (gl_.compatibility && isMesa())) gl_.GetTextureParameteriv = nullptr;
    if (!has(44, "GL_ARB_multi_bind")) gl_.BindTextures = nullptr;
    if (!gl_.BindTextures) gl_.BindSamplers = nullptr;
    if (!has("GL_EXT_stencil_two_side")) gl_.ActiveStencilFaceEXT = nullptr;
  }

  // OpenGL ES 3.2, whose extensions have functions of other names.
  void settleEmbedded(GlLoader loader) {
    const auto take = [&](auto& function, const char* extension, const char* name) {
      function = has(extension) ? reinterpret_cast<std::decay_t<decltype(function)>>(loader(name)) : nullptr;
    };
    gl_.cubeArrays = gl_.indexedBlending = gl_.stencilTexturing = gl_.debugOutput = gl_.feedbackQuery =
        gl_.viewportArrays = true;
    gl_.normalised16 = has("GL_EXT_texture_norm16");
    gl_.dualSource = has("GL_EXT_blend_func_extended");
    take(gl_.ClipControl, "GL_EXT_clip_control", "glClipControlEXT");
    take(gl_.ViewportIndexedf, "GL_OES_viewport_array", "glViewportIndexedfOES");
    take(gl_.ScissorIndexed, "GL_OES_viewport_array", "glScissorIndexedOES");
    take(gl_.GetFloati_v, "GL_OES_viewport_array", "glGetFloati_vOES");
    take(gl_.PolygonMode, "GL_NV_polygon_mode", "glPolygonModeNV");
    take(gl_.QueryCounter, "GL_EXT_disjoint_timer_query", "glQueryCounterEXT");
    take(gl_.GetQueryObjectui64v, "GL_EXT_disjoint_timer_query", "glGetQueryObjectui64vEXT");
    gl_.timerQueries = gl_.QueryCounter && gl_.GetQueryObjectui64v;
    gl_.GetTextureParameteriv = nullptr;
    gl_.BindTextures = nullptr;
    gl_.BindSamplers = nullptr;
    gl_.ActiveStencilFaceEXT = nullptr;
  }

  gl::Functions& gl_;
  std::string version_;
  std::set<std::string> extensions_;
};

std::string neededFor(int version) {
  return "OpenGL " + std::to_string(version / 10) + "." + std::to_string(version % 10) + " core" +
         (version == kLeastVersion ? ", OpenGL ES 3.2" : "") + " or later is needed";
}

} // namespace

Status loadFunctions(gl::Functions& gl, GlLoader loader, int version, const std::string& what) {
  std::string missing = gl.load(loader);
  if (!gl.GetString) return {StatusCode::NoContext, "no GL context is current on this thread"};
  const auto* said = gl.GetString(gl::VERSION); // once: a context may be lost between two calls
  if (!said) return ContextWatch(gl).check();
  const std::string text = reinterpret_cast<const char*>(said);
  if (!gl.GetIntegerv) return {StatusCode::ContextTooOld, "the loader knows no " + missing};
  gl::Int major = 0, minor = 0;
  gl.GetIntegerv(gl::MAJOR_VERSION, &major); // an error, and 0, before OpenGL 3.0
  gl.GetIntegerv(gl::MINOR_VERSION, &minor);
  gl.version = 10 * major + minor;
  const bool embedded = text.rfind("OpenGL ES", 0) == 0;
  if (embedded ? version > kLeastVersion || gl.version < 32 : gl.version < version)
    return {StatusCode::ContextTooOld, "the context is \"" + text + "\": " + neededFor(version) + what};
  gl.language = embedded ? gl::Language::Essl : gl::Language::Glsl;
  if (missing.empty()) {
    Context context(gl, text);
    context.settle(loader);
    missing = gl.loadOwn(loader);
    if (embedded && !context.has("GL_EXT_float_blend"))
      return {StatusCode::ContextTooOld, "the context is \"" + text + "\" without GL_EXT_float_blend, which is needed"};
  }
  if (!missing.empty())
    return {StatusCode::ContextTooOld, "the context is \"" + text + "\" but the loader knows no " + missing};
  return ContextWatch(gl).check();
}

} // namespace tyndall
