// The test context behind functions that count, and that fail as drivers do when told to.
#pragma once

#include "GlThunks.h"

#include <map>
#include <set>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace tests {

/// What fails.
enum class Fault {
  None,
  Compile,      ///< COMPILE_STATUS of a shader is false
  Link,         ///< LINK_STATUS of a program is false
  Binary,       ///< the same of one that glProgramBinary made
  Texture,      ///< no memory for a texture: nothing is allocated, and GL_OUT_OF_MEMORY
  Renderbuffer, ///< the same for a renderbuffer
  Buffer,       ///< and for a buffer
  Framebuffer,  ///< GL_FRAMEBUFFER_UNSUPPORTED
  Any,          ///< all of these
};

const char* nameOf(Fault fault);

/// Every one from the k-th on, the k-th only, or one in eight, by random numbers of the seed k.
enum class Times { From, Only, Random };

/// How programs are compiled.
enum class Compiling {
  AtOnce,   ///< what the context has; all are complete when asked for
  Parallel, ///< with KHR_parallel_shader_compile, complete when COMPLETION_STATUS was asked for a few times
  NoThread, ///< without KHR_parallel_shader_compile
};

/// What was called since the counts were reset.
struct GlCounts {
  int compiles = 0, links = 0, loadedBinaries = 0;
  std::map<std::string, int> made, deleted; ///< names of objects, by the function that made or deleted them
  std::vector<std::string> gpuWaits;        ///< calls that wait for the GPU
  std::vector<std::string> compileWaits;    ///< calls that wait for a compiler, with Compiling::Parallel

  int objects() const; ///< made and deleted
};

/// While it lives, what uses its loader sees the test context through it. One at a time. Shaders of the same text are
/// compiled once only for all that live in it one after the other, since tests make effects by the thousand. One error
/// flag, as GL has: an error is recorded while none is pending.
class FaultyContext {
public:
  FaultyContext();
  ~FaultyContext();
  FaultyContext(const FaultyContext&) = delete;
  FaultyContext& operator=(const FaultyContext&) = delete;

  tyndall::GlLoader loader() const;
  tyndall::CreateResult create(tyndall::Config config = {}) const; ///< with our loader

  void fail(Fault kind, int at, Times times);
  bool heal(); ///< nothing fails any more; true if anything did

  /// The GPU is reset at the k-th call from now on: GL_GUILTY_CONTEXT_RESET once, GL_CONTEXT_LOST for every error that
  /// is asked for, and no other call does or answers anything.
  void loseAt(int call);
  bool isLost() const;
  void recover(); ///< another context has taken its place

  void resetCounts();
  const GlCounts& counts() const;
  int calls() const;
  std::string callsByName() const; ///< the most frequent first

  /// Functions that were asked for and are not among those that count.
  const std::set<std::string>& unknown() const;

  void setCompiling(Compiling compiling);
  void setMaxTextureSize(int size); ///< what GL_MAX_TEXTURE_SIZE says; 0: the context's own
  void setBinaryFormats(int count); ///< 0: no program binaries; 1 else
  void forgetBinaries();            ///< binaries that were given are refused from now on, as by another driver
};

/// glGetError of a context that has failed, or of any other.
GLenum takeGlError();

/// An error becomes pending, unless one is, and no message tells of it.
void setGlError(GLenum error);

} // namespace tests
