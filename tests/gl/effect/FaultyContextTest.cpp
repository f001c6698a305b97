// The watched context itself: what it counts as a wait, its one error flag, and what it lets fail.
#include "FaultyContext.h"
#include "gl/Objects.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <memory>
#include <vector>

using tests::Compiling;
using tests::Fault;
using tests::FaultyContext;
using tests::Times;

namespace {

// All functions, through the watched context.
std::unique_ptr<GladGLContext> load(const FaultyContext& context) {
  auto gl = std::make_unique<GladGLContext>();
  const tyndall::GlLoader loader = context.loader();
  REQUIRE(gladLoadGLContextUserPtr(
      gl.get(),
      [](void* from, const char* name) {
        return reinterpret_cast<GLADapiproc>((*static_cast<const tyndall::GlLoader*>(from))(name));
      },
      const_cast<tyndall::GlLoader*>(&loader)));
  return gl;
}

constexpr const char* kVertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.5); }";
constexpr const char* kFragment = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(0.5); }";

GLuint compile(const GladGLContext& gl, GLenum kind, const char* text) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  return shader;
}

GLuint link(const GladGLContext& gl) {
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, compile(gl, GL_VERTEX_SHADER, kVertex));
  gl.AttachShader(program, compile(gl, GL_FRAGMENT_SHADER, kFragment));
  gl.LinkProgram(program);
  return program;
}

bool isLinked(const GladGLContext& gl, GLuint program) {
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  return linked != 0;
}

std::size_t waits(const FaultyContext& context) { return context.counts().gpuWaits.size(); }

} // namespace

TEST_CASE("watched context: a query's result is a wait, unless it is known to be there") {
  FaultyContext context;
  const auto gl = load(context);
  GLuint query = 0;
  gl->GenQueries(1, &query);
  context.resetCounts();
  for (int round = 0; round < 2; ++round) {
    gl->BeginQuery(GL_SAMPLES_PASSED, query);
    gl->EndQuery(GL_SAMPLES_PASSED);
    GLuint64 value = 0;
    gl->GetQueryObjectui64v(query, GL_QUERY_RESULT, &value);
    CHECK(waits(context) == static_cast<std::size_t>(round) + 1);
    GLuint available = 0;
    while (available == 0)
      gl->GetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
    gl->GetQueryObjectui64v(query, GL_QUERY_RESULT, &value);
    CHECK(waits(context) == static_cast<std::size_t>(round) + 1);
  }
  gl->Finish();
  CHECK(waits(context) == 3);
  gl->DeleteQueries(1, &query);
}

TEST_CASE("watched context: pixels into a buffer are no wait, nor is the buffer once a fence was signalled") {
  FaultyContext context;
  const auto gl = load(context);
  const host::GlFramebuffer framebuffer = host::makeFramebuffer();
  const host::GlTexture texture = host::makeTexture2D(GL_RGBA8, 1, 1);
  gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  GLuint buffer = 0, pixel = 0;
  gl->GenBuffers(1, &buffer);
  gl->BindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  gl->BufferData(GL_PIXEL_PACK_BUFFER, 4, nullptr, GL_STREAM_READ);
  context.resetCounts();
  for (std::size_t round = 0; round < 2; ++round) {
    gl->ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    CHECK(waits(context) == round);
    gl->GetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, 4, &pixel);
    CHECK(waits(context) == round + 1);
    const GLsync fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl->Flush();
    while (gl->ClientWaitSync(fence, 0, 0) == GL_TIMEOUT_EXPIRED) {
    }
    gl->DeleteSync(fence);
    gl->GetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, 4, &pixel);
    CHECK(waits(context) == round + 1);
  }
  gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl->ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &pixel);
  CHECK(waits(context) == 3);
  gl->DeleteBuffers(1, &buffer);
  gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

TEST_CASE("watched context: one error is pending, the first") {
  FaultyContext context;
  const auto gl = load(context);
  GLuint texture = 0;
  gl->GenTextures(1, &texture);
  gl->BindTexture(GL_TEXTURE_2D, texture);
  const auto allocate = [&] {
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 4, 4, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    GLint width = 0;
    gl->GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    return width == 4;
  };
  context.fail(Fault::Texture, 2, Times::Only);
  CHECK(allocate());
  CHECK(gl->GetError() == GL_NO_ERROR);
  gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 8, 8, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
  CHECK(gl->GetError() == GL_OUT_OF_MEMORY);
  CHECK(gl->GetError() == GL_NO_ERROR);
  CHECK(allocate());
  CHECK(context.heal());
  tests::setGlError(GL_INVALID_ENUM);
  context.fail(Fault::Texture, 1, Times::From);
  allocate();
  CHECK(gl->GetError() == GL_INVALID_ENUM);
  CHECK(gl->GetError() == GL_NO_ERROR);
  context.heal();
  gl->DeleteTextures(1, &texture);
  CHECK(context.counts().made.at("glGenTextures") == 1);
  CHECK(context.counts().deleted.at("glDeleteTextures") == 1);
}

TEST_CASE("watched context: shaders and programs fail alone or from one on, and are complete in time") {
  FaultyContext context;
  const auto gl = load(context);
  context.fail(Fault::Compile, 2, Times::Only);
  CHECK_FALSE(isLinked(*gl, link(*gl)));
  CHECK(isLinked(*gl, link(*gl)));
  context.fail(Fault::Link, 2, Times::From);
  CHECK(isLinked(*gl, link(*gl)));
  CHECK_FALSE(isLinked(*gl, link(*gl)));
  CHECK_FALSE(isLinked(*gl, link(*gl)));
  CHECK(context.heal());
  CHECK(context.counts().links == 5);
  CHECK(context.counts().compiles == 10);

  context.setCompiling(Compiling::Parallel);
  GLuint program = link(*gl);
  CHECK(isLinked(*gl, program));
  CHECK(context.counts().compileWaits.size() == 1);
  program = link(*gl);
  GLint complete = 0;
  int asked = 0;
  while (complete == 0 && ++asked < 100)
    gl->GetProgramiv(program, 0x91B1, &complete);
  CHECK(asked > 1);
  CHECK(isLinked(*gl, program));
  CHECK(context.counts().compileWaits.size() == 1);
}

TEST_CASE("watched context: binaries are programs again, unless they are spoiled or refused") {
  if (tests::testContext().glVersion() < 41) return;
  FaultyContext context;
  const auto gl = load(context);
  const GLuint program = link(*gl);
  GLint size = 0;
  gl->GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &size);
  REQUIRE(size > 0);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  GLenum format = 0;
  gl->GetProgramBinary(program, size, nullptr, &format, bytes.data());
  const auto loads = [&](const std::vector<std::uint8_t>& from) {
    const GLuint again = gl->CreateProgram();
    gl->ProgramBinary(again, format, from.data(), static_cast<GLsizei>(from.size()));
    return isLinked(*gl, again);
  };
  CHECK(loads(bytes));
  std::vector<std::uint8_t> spoiled = bytes;
  spoiled.back() ^= 1U;
  CHECK_FALSE(loads(spoiled));
  spoiled = bytes;
  spoiled.pop_back();
  CHECK_FALSE(loads(spoiled));
  context.fail(Fault::Binary, 1, Times::Only);
  CHECK_FALSE(loads(bytes));
  CHECK(loads(bytes));
  context.forgetBinaries();
  CHECK_FALSE(loads(bytes));
}
