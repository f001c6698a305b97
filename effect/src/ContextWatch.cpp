#include "ContextWatch.h"

#include "gl/Enums.h"

namespace tyndall {

// Errors are asked for once, not until there is none: a lost context has one more each time. The engine may learn of
// the reset from us alone, for GL tells some of it only once.
Status ContextWatch::lost() {
  if (!lost_ && gl_.GetGraphicsResetStatus) lost_ = gl_.GetGraphicsResetStatus() != gl::NO_ERROR;
  if (!lost_) lost_ = gl_.GetError() == gl::CONTEXT_LOST;
  if (!lost_) return {};
  return {StatusCode::ContextLost,
          "the GL context was lost by a reset of the GPU: make another, and all objects in it"};
}

Status ContextWatch::check() {
  if (lost_ || gl_.GetString(gl::VERSION)) return lost();
  if (gl_.GetError && gl_.GetError() == gl::CONTEXT_LOST) lost_ = true;
  return lost_ ? lost() : Status{StatusCode::NoContext, "no GL context is current on this thread"};
}

Status ContextWatch::finish(const Status& status) {
  Status loss = lost();
  return loss ? status : loss;
}

Status checkFeedback(const gl::Functions& gl, const char* function) {
  gl::Int active = 0;
  if (gl.version >= 40) gl.GetIntegerv(gl::TRANSFORM_FEEDBACK_ACTIVE, &active);
  if (!active) return {};
  return {StatusCode::InvalidFrame, std::string("transform feedback is active: end it before ") + function};
}

} // namespace tyndall
