// Which calls wait for the GPU: those that read what it may not have written yet.
#include "FaultyState.h"

namespace tests::faulty {

namespace {

using host::gl;

constexpr GLenum kQueryBuffer = 0x9192, kQueryBufferBinding = 0x9193; // of OpenGL 4.4

// Times are numbers of calls that matter here.
struct Buffer {
  bool ours = false;      // it has its storage through our functions
  std::uint64_t last = 0; // time of the last command that wrote to it
};

struct Waits {
  std::uint64_t time = 0, signalled = 0; // all up to then is known to be done
  std::map<GLuint, Buffer> buffers;
  std::map<GLsync, std::uint64_t> fences;
  std::set<GLuint> available; // queries
};

Waits& waits() {
  static Waits theWaits;
  return theWaits;
}

void note(const std::string& call) { state().counts.gpuWaits.push_back(call); }

GLuint boundTo(GLenum target) {
  static const std::map<GLenum, GLenum> bindings = {
      {GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
      {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING},
      {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
      {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
      {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING},
      {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING},
      {GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER_BINDING},
      {GL_TRANSFORM_FEEDBACK_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING},
      {GL_ELEMENT_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER_BINDING},
      {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING},
      {kQueryBuffer, kQueryBufferBinding},
  };
  const auto found = bindings.find(target);
  if (found == bindings.end()) return 0;
  GLint name = 0;
  gl().GetIntegerv(found->second, &name);
  return static_cast<GLuint>(name);
}

void written(GLuint buffer) {
  if (buffer != 0) waits().buffers[buffer].last = ++waits().time;
}

bool isDone(GLuint buffer) {
  const auto found = waits().buffers.find(buffer);
  return found != waits().buffers.end() && found->second.ours && found->second.last <= waits().signalled;
}

void GLAD_API_PTR finish() {
  note("glFinish");
  gl().Finish();
}

// ---------------------------------------------------------------------------------------------------------------------
// Queries

bool intoBuffer() {
  GLint major = 0, minor = 0, name = 0;
  gl().GetIntegerv(GL_MAJOR_VERSION, &major);
  gl().GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor >= 44) gl().GetIntegerv(kQueryBufferBinding, &name);
  written(static_cast<GLuint>(name));
  return name != 0;
}

template <auto kMember>
struct QueryObject;
template <typename Value, void (GLAD_API_PTR* GladGLContext::*kMember)(GLuint, GLenum, Value*)>
struct QueryObject<kMember> {
  static void GLAD_API_PTR call(GLuint id, GLenum name, Value* value) {
    const bool buffered = intoBuffer();
    if (name == GL_QUERY_RESULT && !buffered && waits().available.count(id) == 0) note("glGetQueryObject");
    (gl().*kMember)(id, name, value);
    if (name == GL_QUERY_RESULT_AVAILABLE && !buffered && *value != 0) waits().available.insert(id);
  }
};

void GLAD_API_PTR beginQuery(GLenum target, GLuint id) {
  waits().available.erase(id);
  gl().BeginQuery(target, id);
}
void GLAD_API_PTR queryCounter(GLuint id, GLenum target) {
  waits().available.erase(id);
  gl().QueryCounter(id, target);
}

// ---------------------------------------------------------------------------------------------------------------------
// Images

// With a pack buffer what is read arrives there later.
void readsImage(const std::string& call) {
  const GLuint buffer = boundTo(GL_PIXEL_PACK_BUFFER);
  written(buffer);
  if (buffer == 0) note(call);
}

void GLAD_API_PTR getTexImage(GLenum target, GLint level, GLenum format, GLenum type, void* pixels) {
  readsImage("glGetTexImage");
  gl().GetTexImage(target, level, format, type, pixels);
}
void GLAD_API_PTR getTextureImage(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei size, void* pixels) {
  readsImage("glGetTextureImage");
  gl().GetTextureImage(texture, level, format, type, size, pixels);
}
void GLAD_API_PTR readPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type,
                             void* pixels) {
  readsImage("glReadPixels");
  gl().ReadPixels(x, y, width, height, format, type, pixels);
}

// ---------------------------------------------------------------------------------------------------------------------
// Buffers

void GLAD_API_PTR bufferData(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
  if (fails(Fault::Buffer)) return recordError(GL_OUT_OF_MEMORY);
  waits().buffers[boundTo(target)] = {true, 0}; // new storage: nothing to wait for
  gl().BufferData(target, size, data, usage);
}
void GLAD_API_PTR bufferStorage(GLenum target, GLsizeiptr size, const void* data, GLbitfield flags) {
  if (fails(Fault::Buffer)) return recordError(GL_OUT_OF_MEMORY);
  waits().buffers[boundTo(target)] = {true, 0};
  gl().BufferStorage(target, size, data, flags);
}
void GLAD_API_PTR copyBufferSubData(GLenum from, GLenum to, GLintptr fromOffset, GLintptr toOffset, GLsizeiptr size) {
  written(boundTo(to));
  gl().CopyBufferSubData(from, to, fromOffset, toOffset, size);
}
void GLAD_API_PTR getBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, void* data) {
  if (!isDone(boundTo(target))) note("glGetBufferSubData");
  gl().GetBufferSubData(target, offset, size, data);
}
void* GLAD_API_PTR mapBuffer(GLenum target, GLenum access) {
  if (!isDone(boundTo(target))) note("glMapBuffer");
  return gl().MapBuffer(target, access);
}
void* GLAD_API_PTR mapBufferRange(GLenum target, GLintptr offset, GLsizeiptr length, GLbitfield access) {
  const GLbitfield never = GL_MAP_UNSYNCHRONIZED_BIT | GL_MAP_INVALIDATE_BUFFER_BIT;
  if ((access & never) == 0 && !isDone(boundTo(target))) note("glMapBufferRange");
  return gl().MapBufferRange(target, offset, length, access);
}
void GLAD_API_PTR getNamedBufferSubData(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  if (!isDone(buffer)) note("glGetNamedBufferSubData");
  gl().GetNamedBufferSubData(buffer, offset, size, data);
}

// ---------------------------------------------------------------------------------------------------------------------
// Fences

GLsync GLAD_API_PTR fenceSync(GLenum condition, GLbitfield flags) {
  GLsync sync = gl().FenceSync(condition, flags);
  waits().fences[sync] = ++waits().time;
  return sync;
}

void seen(GLsync sync) { waits().signalled = std::max(waits().signalled, waits().fences[sync]); }

GLenum GLAD_API_PTR clientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout) {
  if (timeout > 0) note("glClientWaitSync");
  const GLenum result = gl().ClientWaitSync(sync, flags, timeout);
  if (result == GL_ALREADY_SIGNALED || result == GL_CONDITION_SATISFIED) seen(sync);
  return result;
}
void GLAD_API_PTR getSynciv(GLsync sync, GLenum name, GLsizei count, GLsizei* length, GLint* values) {
  gl().GetSynciv(sync, name, count, length, values);
  if (name == GL_SYNC_STATUS && count > 0 && *values == GL_SIGNALED) seen(sync);
}
void GLAD_API_PTR deleteSync(GLsync sync) {
  waits().fences.erase(sync);
  gl().DeleteSync(sync);
}

} // namespace

void replaceWaits(Targets& targets) {
  targets[Call::Finish] = addressOf(finish);
  targets[Call::GetQueryObjectiv] = addressOf(QueryObject<&GladGLContext::GetQueryObjectiv>::call);
  targets[Call::GetQueryObjectuiv] = addressOf(QueryObject<&GladGLContext::GetQueryObjectuiv>::call);
  targets[Call::GetQueryObjecti64v] = addressOf(QueryObject<&GladGLContext::GetQueryObjecti64v>::call);
  targets[Call::GetQueryObjectui64v] = addressOf(QueryObject<&GladGLContext::GetQueryObjectui64v>::call);
  targets[Call::BeginQuery] = addressOf(beginQuery);
  targets[Call::QueryCounter] = addressOf(queryCounter);
  targets[Call::GetTexImage] = addressOf(getTexImage);
  targets[Call::GetTextureImage] = addressOf(getTextureImage);
  targets[Call::ReadPixels] = addressOf(readPixels);
  targets[Call::BufferData] = addressOf(bufferData);
  targets[Call::BufferStorage] = addressOf(bufferStorage);
  targets[Call::CopyBufferSubData] = addressOf(copyBufferSubData);
  targets[Call::GetBufferSubData] = addressOf(getBufferSubData);
  targets[Call::GetNamedBufferSubData] = addressOf(getNamedBufferSubData);
  targets[Call::MapBuffer] = addressOf(mapBuffer);
  targets[Call::MapBufferRange] = addressOf(mapBufferRange);
  targets[Call::FenceSync] = addressOf(fenceSync);
  targets[Call::ClientWaitSync] = addressOf(clientWaitSync);
  targets[Call::GetSynciv] = addressOf(getSynciv);
  targets[Call::DeleteSync] = addressOf(deleteSync);
}

void clearWaits() { waits() = {}; }

} // namespace tests::faulty
