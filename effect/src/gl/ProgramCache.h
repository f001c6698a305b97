// Builds programs, a vertex shader (full-screen unless named) with one fragment shader of glsl/passes, or a compute
// shader, and keeps them.
#pragma once

#include "gl/Program.h"
#include "gl/ProgramBinaries.h"
#include "gl/Variant.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tyndall::gl {

/// request() and poll() build ahead; find() has what is needed now. All but size() and error() may leave a program of
/// ours in use.
///
/// GL is asked how far a program is only when it must be, so that drivers compile several at a time on threads of their
/// own. How many they take is the engine's choice (glMaxShaderCompilerThreadsKHR): as many as they like, unless it
/// said otherwise.
class ProgramCache {
public:
  explicit ProgramCache(const Functions& gl, ProgramStore store = {});
  ~ProgramCache();
  ProgramCache(const ProgramCache&) = delete;
  ProgramCache& operator=(const ProgramCache&) = delete;

  /// Starts to build it, unless it is being built or known. After find() has told of a failure all that are not built
  /// are tried again.
  void request(const Variant& variant);

  /// Takes up those that are complete; how many are still being built. Waits for none where the context says which are
  /// complete (GL_KHR_parallel_shader_compile), else for all.
  int poll();

  /// Builds it if request() was not called, and waits for it. Null if it does not build: error() has its key and the
  /// driver's log.
  const Program* find(const Variant& variant);

  /// The program of a fragment shader ("passes/exact.frag"), by find(); 0 if it does not build. Leaves it in use.
  Uint use(const std::string& fragment, const Definitions& definitions, const std::string& vertex = kFullScreen);
  /// The same of a compute shader ("passes/avsmSort.comp"), which needs OpenGL 4.3.
  Uint useCompute(const std::string& file, const Definitions& definitions) { return use(file, definitions, {}); }

  const std::string& error() const { return error_; }
  int size() const { return built_; } ///< programs that are built

private:
  class Shader;
  struct Build;
  using ShaderPointer = std::shared_ptr<Shader>;

  Build& buildOf(const Variant& variant);
  void start(Build& build);
  void compile(Build& build);
  ShaderPointer sharedVertex(const std::string& file, const Definitions& definitions);
  bool isComplete(const Build& build) const;
  void finish(Build& build);
  std::string failureOf(const Build& build) const;
  void fail(Build& build);
  void startOver();

  const Functions& gl_;
  ProgramBinaries binaries_;
  std::map<std::string, std::unique_ptr<Build>> builds_; ///< by what their shaders mention
  std::map<std::string, Build*> known_;                  ///< by what was asked for
  std::map<std::string, ShaderPointer> vertexShaders_;   ///< by their text: few
  std::string error_;
  int built_ = 0;
};

} // namespace tyndall::gl
