#include "ContextWatch.h"

#include "gl/OwnErrors.h"

#include <atomic>

namespace tyndall {

namespace {

// Between glBegin and glEnd GL answers nothing, as without a context.
Status noContext(const gl::Functions& gl) {
  const bool mayBegin = gl.version == 0 || gl.compatibility;
  return {StatusCode::NoContext, std::string("no GL context is current on this thread") +
                                     (mayBegin ? ", or glBegin was called in it without glEnd" : "")};
}

} // namespace

// The number is the divisor of an attribute that no draw of ours reads.
void ContextWatch::mark() {
  static std::atomic<int> count{0};
  number_ = 1000 + ++count % 1000000;
  array_ = gl::VertexArray(gl_);
  gl_.BindVertexArray(array_.name());
  gl_.VertexAttribDivisor(0, static_cast<gl::Uint>(number_));
}

bool ContextWatch::holdsMarks() const {
  if (!gl_.IsVertexArray(array_.name())) return false;
  gl::Int bound = 0, number = 0;
  gl_.GetIntegerv(gl::VERTEX_ARRAY_BINDING, &bound);
  gl_.BindVertexArray(array_.name());
  gl_.GetVertexAttribiv(0, gl::VERTEX_ATTRIB_ARRAY_DIVISOR, &number);
  gl_.BindVertexArray(static_cast<gl::Uint>(bound));
  return number == number_;
}

// GL may tell of a reset only once: the engine may learn of it from us alone.
bool ContextWatch::wasReset() const {
  return gl_.GetGraphicsResetStatus && gl_.GetGraphicsResetStatus() != gl::NO_ERROR;
}

Status ContextWatch::lost() {
  lost_ = true;
  return {StatusCode::ContextLost,
          "the GL context was lost by a reset of the GPU: make another, and all objects in it"};
}

Status ContextWatch::check() {
  if (lost_) return lost();
  if (!gl_.GetString(gl::VERSION)) { // in a context that is lost, too
    if (gl_.GetError && gl_.GetError() == gl::CONTEXT_LOST) return lost();
    return noContext(gl_);
  }
  if (wasReset()) return lost();
  if (number_ == 0 || holdsMarks()) return {};
  if (gl::OwnErrors(gl_).contextLost()) return lost();
  return {StatusCode::NoContext, "another GL context is current than the one that create() saw"};
}

// The context has been ours: if an object of ours is gone, all are.
Status ContextWatch::finish(const Status& status) {
  if (lost_ || wasReset() || (number_ != 0 && !gl_.IsVertexArray(array_.name()))) return lost();
  return status;
}

Status checkLists(const gl::Functions& gl, const char* function) {
  gl::Int list = 0;
  if (gl.compatibility) gl.GetIntegerv(gl::LIST_INDEX, &list);
  if (list == 0) return {};
  return {StatusCode::InvalidFrame,
          "display list " + std::to_string(list) + " is being compiled: call glEndList before " + function};
}

Status checkUnderWay(const gl::Functions& gl, const char* function) {
  gl::Int active = 0;
  if (gl.feedbackQuery) gl.GetIntegerv(gl::TRANSFORM_FEEDBACK_ACTIVE, &active);
  if (active) return {StatusCode::InvalidFrame, std::string("transform feedback is active: end it before ") + function};
  gl::Int mode = gl::RENDER;
  if (gl.compatibility) gl.GetIntegerv(gl::RENDER_MODE, &mode);
  if (mode != gl::RENDER)
    return {StatusCode::InvalidFrame, std::string("glRenderMode is ") +
                                          (mode == gl::FEEDBACK ? "GL_FEEDBACK" : "GL_SELECT") +
                                          ": set GL_RENDER before " + function};
  return checkLists(gl, function);
}

} // namespace tyndall
