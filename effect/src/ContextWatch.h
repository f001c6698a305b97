// Whether GL can be called at all: a context is current, and it is not lost.
#pragma once

#include "gl/Functions.h"

#include <tyndall/tyndall.h>

namespace tyndall {

class ContextWatch {
public:
  explicit ContextWatch(const gl::Functions& gl) : gl_(gl) {}

  /// Before a call's work: NoContext, ContextLost, or Ok. A context that was lost stays so.
  Status check();

  /// After it: what became of it, unless the context was lost meanwhile.
  Status finish(const Status& status);

private:
  Status lost();

  const gl::Functions& gl_;
  bool lost_ = false;
};

/// InvalidFrame while transform feedback is active, during which GL lets no other program be used.
Status checkFeedback(const gl::Functions& gl, const char* function);

} // namespace tyndall
