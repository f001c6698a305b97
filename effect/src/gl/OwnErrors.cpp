#include "gl/OwnErrors.h"

#include "gl/Objects.h"

#include <algorithm>
#include <limits>

namespace tyndall::gl {

namespace {

constexpr int kMostErrors = 16; // GL may keep a flag of each kind, and several of each

Int integer(const Functions& gl, Enum name) {
  Int value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

// Always refused: no query is called 0.
void raiseInvalidOperation(const Functions& gl) { gl.BeginQuery(ANY_SAMPLES_PASSED, 0); }

// One without attachments is not complete.
void raiseInvalidFramebufferOperation(const Functions& gl) {
  const auto bound = static_cast<Uint>(integer(gl, DRAW_FRAMEBUFFER_BINDING));
  const Framebuffer empty(gl);
  gl.BindFramebuffer(DRAW_FRAMEBUFFER, empty.name());
  gl.Clear(COLOR_BUFFER_BIT);
  gl.BindFramebuffer(DRAW_FRAMEBUFFER, bound);
}

// More than any machine can address.
void raiseOutOfMemory(const Functions& gl) {
  const auto bound = static_cast<Uint>(integer(gl, UNIFORM_BUFFER_BINDING));
  const Buffer buffer(gl);
  gl.BindBuffer(UNIFORM_BUFFER, buffer.name());
  gl.BufferData(UNIFORM_BUFFER, std::numeric_limits<Sizeiptr>::max(), nullptr, STREAM_DRAW);
  gl.BindBuffer(UNIFORM_BUFFER, bound);
}

// Only debug groups have a stack that can be filled and left as it was. Those of the engine's cannot be taken from it
// and put back, so while it has some, an underflow becomes another error.
void raiseStackOverflow(const Functions& gl) {
  const int room = integer(gl, MAX_DEBUG_GROUP_STACK_DEPTH) - integer(gl, DEBUG_GROUP_STACK_DEPTH);
  for (int i = 0; i <= room; ++i)
    gl.PushDebugGroup(DEBUG_SOURCE_THIRD_PARTY, 0, -1, "Tyndall");
  for (int i = 0; i < room; ++i)
    gl.PopDebugGroup();
}

void raise(const Functions& gl, Enum error) {
  switch (error) {
  case INVALID_ENUM:
    return gl.Enable(INVALID_INDEX);
  case INVALID_VALUE:
    return gl.PixelStorei(UNPACK_ALIGNMENT, 0);
  case INVALID_FRAMEBUFFER_OPERATION:
    return raiseInvalidFramebufferOperation(gl);
  case OUT_OF_MEMORY:
    return raiseOutOfMemory(gl);
  case STACK_OVERFLOW:
    return gl.debugOutput ? raiseStackOverflow(gl) : raiseInvalidOperation(gl);
  case STACK_UNDERFLOW:
    return gl.debugOutput && integer(gl, DEBUG_GROUP_STACK_DEPTH) == 1 ? gl.PopDebugGroup() : raiseInvalidOperation(gl);
  default:
    return raiseInvalidOperation(gl);
  }
}

} // namespace

OwnErrors::OwnErrors(const Functions& gl) : gl_(gl), engines_(askAll()) {}

OwnErrors::~OwnErrors() {
  askAll();
  if (engines_.empty() || lost_) return;
  const bool speaks = gl_.debugOutput && gl_.IsEnabled(DEBUG_OUTPUT);
  if (speaks) gl_.Disable(DEBUG_OUTPUT); // the callback has had its message
  for (const Enum error : engines_)
    raise(gl_, error);
  if (speaks) gl_.Enable(DEBUG_OUTPUT);
}

Enum OwnErrors::take() {
  const std::vector<Enum> errors = askAll();
  return errors.empty() ? Enum{lost_ ? CONTEXT_LOST : NO_ERROR} : errors.front();
}

// Each kind once.
std::vector<Enum> OwnErrors::askAll() {
  std::vector<Enum> errors;
  for (int i = 0; i < kMostErrors && !lost_; ++i) {
    const Enum error = gl_.GetError();
    if (error == NO_ERROR) break;
    lost_ = error == CONTEXT_LOST;
    if (!lost_ && std::find(errors.begin(), errors.end(), error) == errors.end()) errors.push_back(error);
  }
  return errors;
}

} // namespace tyndall::gl
