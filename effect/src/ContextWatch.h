// Whether GL can be called at all: a context is current, the one that it was, and it is not lost.
#pragma once

#include "gl/Objects.h"

#include <tyndall/tyndall.h>

namespace tyndall {

class ContextWatch {
public:
  explicit ContextWatch(const gl::Functions& gl) : gl_(gl) {}

  /// Makes the current context the one to watch. Binds a vertex array: call it under a StateGuard.
  void mark();

  /// Before a call's work: NoContext (none, or another than the marked one), ContextLost, or Ok. A context that was
  /// lost stays so. Asks for errors only where the context is not the one that it was.
  Status check();

  /// After it: what became of it, unless the context was lost meanwhile.
  Status finish(const Status& status);

private:
  bool holdsMarks() const;
  bool wasReset() const;
  Status lost();

  const gl::Functions& gl_;
  bool lost_ = false;
  // A vertex array is no other context's, not even of one that shares objects with ours; but another context's may have
  // its name: it keeps a number.
  gl::VertexArray array_;
  gl::Int number_ = 0;
};

/// InvalidFrame while what is drawn would not be drawn: while transform feedback is active, during which GL lets no
/// other program be used, and in the compatibility profile while a list is being compiled or primitives only counted.
Status checkUnderWay(const gl::Functions& gl, const char* function);
/// The part of it that keeps objects from being made.
Status checkLists(const gl::Functions& gl, const char* function);

} // namespace tyndall
