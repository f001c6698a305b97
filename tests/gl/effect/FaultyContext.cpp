#include "FaultyContext.h"

#include "FaultyState.h"
#include "support/TestContext.h"

#include <algorithm>
#include <sstream>
#include <utility>

using namespace tyndall;

namespace tests {

namespace faulty {

State& state() {
  static State theState;
  return theState;
}

namespace {

// By the finaliser of MurmurHash3.
bool isChosen(int seed, int seen) {
  std::uint32_t hash = static_cast<std::uint32_t>(seed) * 0x9E3779B9U + static_cast<std::uint32_t>(seen);
  hash = (hash ^ (hash >> 16U)) * 0x85EBCA6BU;
  hash = (hash ^ (hash >> 13U)) * 0xC2B2AE35U;
  return (hash ^ (hash >> 16U)) % 8 == 0;
}

bool isDue(const State& s) {
  switch (s.times) {
  case Times::From:
    return s.seen >= s.at;
  case Times::Only:
    return s.seen == s.at;
  default:
    return isChosen(s.at, s.seen);
  }
}

// A lost context does nothing but say so.
bool isSwallowed(Call call) {
  State& s = state();
  if (s.callsLeft > 0 && --s.callsLeft == 0) s.lost = true;
  return s.lost && call != Call::GetError && call != Call::GetGraphicsResetStatus;
}

} // namespace

bool fails(Fault kind) {
  State& s = state();
  if (s.kind != kind && s.kind != Fault::Any) return false;
  ++s.seen;
  const bool now = isDue(s);
  s.triggered = s.triggered || now;
  return now;
}

void recordError(GLenum error) {
  State& s = state();
  if (s.error == GL_NO_ERROR) s.error = host::gl().GetError();
  if (s.error == GL_NO_ERROR) s.error = error;
}

namespace {

// What the context recorded while ours was pending would not have been recorded.
GLenum GLAD_API_PTR getError() {
  if (state().lost) return GL_CONTEXT_LOST;
  const GLenum own = host::gl().GetError();
  const GLenum ours = std::exchange(state().error, GL_NO_ERROR);
  return ours != GL_NO_ERROR ? ours : own;
}

// The loader's own, as the effect asks for it: glad leaves it out of contexts older than it.
GLenum GLAD_API_PTR getResetStatus() {
  State& s = state();
  if (!s.lost)
    return reinterpret_cast<PFNGLGETGRAPHICSRESETSTATUSPROC>(testContext().loader()("glGetGraphicsResetStatus"))();
  return std::exchange(s.toldOfReset, true) ? GL_NO_ERROR : GL_GUILTY_CONTEXT_RESET;
}

template <Fault kKind, auto kMember>
struct Allocation;
template <Fault kKind, typename... A, void (GLAD_API_PTR* GladGLContext::*kMember)(A...)>
struct Allocation<kKind, kMember> {
  static void GLAD_API_PTR call(A... arguments) {
    if (fails(kKind))
      recordError(GL_OUT_OF_MEMORY);
    else
      (host::gl().*kMember)(arguments...);
  }
};

template <Call kCall, auto kMember>
struct Objects;
template <Call kCall, void (GLAD_API_PTR* GladGLContext::*kMember)(GLsizei, GLuint*)>
struct Objects<kCall, kMember> {
  static void GLAD_API_PTR call(GLsizei n, GLuint* names) {
    state().counts.made[nameOf(kCall)] += n;
    (host::gl().*kMember)(n, names);
  }
};
template <Call kCall, void (GLAD_API_PTR* GladGLContext::*kMember)(GLenum, GLsizei, GLuint*)>
struct Objects<kCall, kMember> {
  static void GLAD_API_PTR call(GLenum target, GLsizei n, GLuint* names) {
    state().counts.made[nameOf(kCall)] += n;
    (host::gl().*kMember)(target, n, names);
  }
};
template <Call kCall, void (GLAD_API_PTR* GladGLContext::*kMember)(GLsizei, const GLuint*)>
struct Objects<kCall, kMember> {
  static void GLAD_API_PTR call(GLsizei n, const GLuint* names) {
    const auto some = std::count_if(names, names + n, [](GLuint name) { return name != 0; });
    if (some > 0) state().counts.deleted[nameOf(kCall)] += static_cast<int>(some);
    (host::gl().*kMember)(n, names);
  }
};

template <GLenum (GLAD_API_PTR* GladGLContext::*kMember)(GLenum)>
GLenum GLAD_API_PTR checkStatus(GLenum target) {
  return fails(Fault::Framebuffer) ? GL_FRAMEBUFFER_UNSUPPORTED : (host::gl().*kMember)(target);
}
GLenum GLAD_API_PTR checkNamedStatus(GLuint name, GLenum target) {
  return fails(Fault::Framebuffer) ? GL_FRAMEBUFFER_UNSUPPORTED : host::gl().CheckNamedFramebufferStatus(name, target);
}

// The context's extensions, and with Compiling::Parallel one more.
GLint ownExtensions() {
  GLint count = 0;
  host::gl().GetIntegerv(GL_NUM_EXTENSIONS, &count);
  return count;
}
const GLubyte* GLAD_API_PTR getStringi(GLenum name, GLuint index) {
  const auto* hidden = reinterpret_cast<const GLubyte*>("GL_TYNDALL_hidden");
  const auto* parallel = reinterpret_cast<const GLubyte*>("GL_KHR_parallel_shader_compile");
  if (name != GL_EXTENSIONS) return host::gl().GetStringi(name, index);
  if (index == static_cast<GLuint>(ownExtensions())) return parallel;
  const GLubyte* own = host::gl().GetStringi(name, index);
  const bool isParallel =
      own && std::string(reinterpret_cast<const char*>(own)).find("parallel_shader_compile") != std::string::npos;
  return isParallel && state().compiling == Compiling::NoThread ? hidden : own;
}

void GLAD_API_PTR getIntegerv(GLenum name, GLint* value) {
  const State& s = state();
  if (name == GL_NUM_EXTENSIONS && s.compiling == Compiling::Parallel)
    *value = ownExtensions() + 1;
  else if (name == GL_MAX_TEXTURE_SIZE && s.maxTextureSize > 0)
    *value = s.maxTextureSize;
  else if (name == GL_NUM_PROGRAM_BINARY_FORMATS)
    *value = s.binaryFormats;
  else if (name == GL_PROGRAM_BINARY_FORMATS && s.binaryFormats > 0)
    *value = 0xB1A5; // VirtualPrograms.cpp makes them
  else if (name != GL_PROGRAM_BINARY_FORMATS)
    host::gl().GetIntegerv(name, value);
}

#define TESTS_ALLOCATES(kind, name) targets[Call::name] = addressOf(Allocation<Fault::kind, &GladGLContext::name>::call)
#define TESTS_OBJECTS(name) targets[Call::name] = addressOf(Objects<Call::name, &GladGLContext::name>::call)

void replaceObjects(Targets& targets) {
  TESTS_OBJECTS(GenTextures);
  TESTS_OBJECTS(GenBuffers);
  TESTS_OBJECTS(GenFramebuffers);
  TESTS_OBJECTS(GenRenderbuffers);
  TESTS_OBJECTS(GenSamplers);
  TESTS_OBJECTS(GenVertexArrays);
  TESTS_OBJECTS(GenQueries);
  TESTS_OBJECTS(GenProgramPipelines);
  TESTS_OBJECTS(GenTransformFeedbacks);
  TESTS_OBJECTS(CreateTextures);
  TESTS_OBJECTS(CreateBuffers);
  TESTS_OBJECTS(CreateFramebuffers);
  TESTS_OBJECTS(CreateRenderbuffers);
  TESTS_OBJECTS(CreateSamplers);
  TESTS_OBJECTS(CreateVertexArrays);
  TESTS_OBJECTS(CreateQueries);
  TESTS_OBJECTS(CreateProgramPipelines);
  TESTS_OBJECTS(DeleteTextures);
  TESTS_OBJECTS(DeleteBuffers);
  TESTS_OBJECTS(DeleteFramebuffers);
  TESTS_OBJECTS(DeleteRenderbuffers);
  TESTS_OBJECTS(DeleteSamplers);
  TESTS_OBJECTS(DeleteVertexArrays);
  TESTS_OBJECTS(DeleteQueries);
  TESTS_OBJECTS(DeleteProgramPipelines);
  TESTS_OBJECTS(DeleteTransformFeedbacks);
}

} // namespace

void replaceAllocations(Targets& targets) {
  replaceObjects(targets);
  targets[Call::GetError] = addressOf(getError);
  targets[Call::GetGraphicsResetStatus] = addressOf(getResetStatus);
  targets[Call::GetIntegerv] = addressOf(getIntegerv);
  targets[Call::GetStringi] = addressOf(getStringi);
  targets[Call::CheckFramebufferStatus] = addressOf(checkStatus<&GladGLContext::CheckFramebufferStatus>);
  targets[Call::CheckNamedFramebufferStatus] = addressOf(checkNamedStatus);
  TESTS_ALLOCATES(Texture, TexImage1D);
  TESTS_ALLOCATES(Texture, TexImage2D);
  TESTS_ALLOCATES(Texture, TexImage3D);
  TESTS_ALLOCATES(Texture, TexImage2DMultisample);
  TESTS_ALLOCATES(Texture, CopyTexImage2D);
  TESTS_ALLOCATES(Texture, TexStorage1D);
  TESTS_ALLOCATES(Texture, TexStorage2D);
  TESTS_ALLOCATES(Texture, TexStorage3D);
  TESTS_ALLOCATES(Texture, TexStorage2DMultisample);
  TESTS_ALLOCATES(Texture, TextureStorage2D);
  TESTS_ALLOCATES(Texture, TextureStorage3D);
  TESTS_ALLOCATES(Texture, TextureStorage2DMultisample);
  TESTS_ALLOCATES(Renderbuffer, RenderbufferStorage);
  TESTS_ALLOCATES(Renderbuffer, RenderbufferStorageMultisample);
  TESTS_ALLOCATES(Renderbuffer, NamedRenderbufferStorage);
  TESTS_ALLOCATES(Buffer, NamedBufferStorage);
  TESTS_ALLOCATES(Buffer, NamedBufferData);
}

} // namespace faulty

namespace {

using faulty::state;

// That no test needs to count.
const std::set<std::string> kPassedOn = {"glGetGraphicsResetStatusARB", "glMaxShaderCompilerThreadsKHR",
                                         "glActiveStencilFaceEXT", "glPixelTransferf", "glMaxShaderCompilerThreadsARB"};

void* faultyLoader(const char* name) {
  void* real = testContext().loader()(name);
  if (!real) return nullptr;
  const Call call = callNamed(name);
  if (call != Call::Count) return thunkOf(call);
  if (kPassedOn.count(name) == 0) state().unknown.insert(name);
  return real;
}

void aim() {
  faulty::Targets targets;
  faulty::replaceAllocations(targets);
  faulty::replacePrograms(targets);
  faulty::replaceWaits(targets);
  for (std::size_t i = 0; i < kCalls; ++i) {
    const auto replaced = targets.find(static_cast<Call>(i));
    void* real = testContext().loader()(nameOf(static_cast<Call>(i)));
    callRows()[i] = {replaced != targets.end() ? replaced->second : real, 0};
  }
}

} // namespace

const char* nameOf(Fault fault) {
  constexpr const char* kNames[] = {
      "none", "compile", "link", "binary", "texture", "renderbuffer", "buffer", "framebuffer status", "any"};
  return kNames[static_cast<std::size_t>(fault)];
}

int GlCounts::objects() const {
  int sum = 0;
  for (const auto* names : {&made, &deleted})
    for (const auto& entry : *names)
      sum += entry.second;
  return sum;
}

FaultyContext::FaultyContext() {
  testContext();
  state() = {};
  aim();
}

FaultyContext::~FaultyContext() {
  faulty::clearPrograms();
  faulty::clearWaits();
  recover();
  state() = {};
}

GlLoader FaultyContext::loader() const { return faultyLoader; }

CreateResult FaultyContext::create(Config config) const {
  config.loader = faultyLoader;
  return Effect::create(config);
}

void FaultyContext::fail(Fault kind, int at, Times times) {
  faulty::State& s = state();
  s.kind = kind;
  s.at = at;
  s.times = times;
  s.seen = 0;
  s.triggered = false;
}

bool FaultyContext::heal() {
  state().kind = Fault::None;
  return state().triggered;
}

void FaultyContext::loseAt(int call) {
  state().callsLeft = call;
  swallowsCall() = faulty::isSwallowed;
}

bool FaultyContext::isLost() const { return state().lost; }

void FaultyContext::recover() {
  faulty::State& s = state();
  s.callsLeft = -1;
  s.lost = s.toldOfReset = false;
  swallowsCall() = nullptr;
}

void FaultyContext::resetCounts() {
  for (CallRow& row : callRows())
    row.count = 0;
  state().counts = {};
}

const GlCounts& FaultyContext::counts() const { return state().counts; }

int FaultyContext::calls() const {
  int sum = 0;
  for (const CallRow& row : callRows())
    sum += row.count;
  return sum;
}

std::string FaultyContext::callsByName() const {
  std::vector<std::pair<int, std::string>> all;
  for (std::size_t i = 0; i < kCalls; ++i)
    if (const int count = callRows()[i].count; count > 0) all.emplace_back(-count, nameOf(static_cast<Call>(i)));
  std::sort(all.begin(), all.end());
  std::ostringstream text;
  for (const auto& [negative, name] : all)
    text << -negative << " " << name << ", ";
  return text.str();
}

const std::set<std::string>& FaultyContext::unknown() const { return state().unknown; }

void FaultyContext::setCompiling(Compiling compiling) { state().compiling = compiling; }
void FaultyContext::setMaxTextureSize(int size) { state().maxTextureSize = size; }
void FaultyContext::setBinaryFormats(int count) { state().binaryFormats = count; }
void FaultyContext::forgetBinaries() { faulty::forgetBinaries(); }

GLenum takeGlError() {
  const GLenum own = host::gl().GetError();
  const GLenum ours = std::exchange(state().error, GL_NO_ERROR);
  return ours != GL_NO_ERROR ? ours : own;
}

void setGlError(GLenum error) { faulty::recordError(error); }

} // namespace tests
