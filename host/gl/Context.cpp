#include "gl/Context.h"

#include "gl/Gl.h"
#include "gl/NativeContext.h"
#include "scene/Error.h"
#include "scene/Tool.h"

#include <type_traits>

namespace host {

namespace {

thread_local Context* currentContext = nullptr;

std::unique_ptr<NativeContext> createNative(ContextKind kind, const ContextOptions& options) {
  switch (kind) {
  case ContextKind::Osmesa:
    return createOsmesaContext(options);
  case ContextKind::Egl:
    return createEglContext(options);
  case ContextKind::Glfw:
    return createGlfwContext(options);
  }
  throw Error("context: unknown kind");
}

/// A window's, which outlives it.
class AdoptedContext final : public NativeContext {
public:
  AdoptedContext(Context::Loader resolve, std::function<void(bool)> setCurrent)
      : loader_(resolve), setCurrent_(std::move(setCurrent)) {}
  void bind() override { setCurrent_(true); }
  void unbind() override { setCurrent_(false); }
  Context::Loader loader() const override { return loader_; }

private:
  Context::Loader loader_;
  std::function<void(bool)> setCurrent_;
};

/// What the shader compiler says comes with the compile status, to those who asked for it.
void collectMessage(GLenum source, GLenum type, GLuint /*id*/, GLenum severity, GLsizei /*length*/,
                    const GLchar* message, const void* messages) {
  const bool severe = type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH;
  if (severe && source != GL_DEBUG_SOURCE_SHADER_COMPILER) {
    static_cast<std::vector<std::string>*>(const_cast<void*>(messages))->emplace_back(message);
  }
}

std::string nameOfError(GLenum error) {
  switch (error) {
  case GL_INVALID_ENUM:
    return "GL_INVALID_ENUM";
  case GL_INVALID_VALUE:
    return "GL_INVALID_VALUE";
  case GL_INVALID_OPERATION:
    return "GL_INVALID_OPERATION";
  case GL_INVALID_FRAMEBUFFER_OPERATION:
    return "GL_INVALID_FRAMEBUFFER_OPERATION";
  case GL_OUT_OF_MEMORY:
    return "GL_OUT_OF_MEMORY";
  default:
    return "GL error " + std::to_string(error);
  }
}

std::string glString(GLenum name) {
  const GLubyte* text = gl().GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "?";
}

} // namespace

const GladGLContext& gl() {
  if (!currentContext) {
    throw Error("GL: no context of the host is current in this thread");
  }
  return currentContext->functions();
}

bool isEmbedded() { return currentContext && currentContext->profile() == ContextProfile::Embedded; }

ContextKind parseContextKind(const std::string& name) {
  for (const ContextKind kind : {ContextKind::Osmesa, ContextKind::Egl, ContextKind::Glfw}) {
    if (name == nameOf(kind)) {
      return kind;
    }
  }
  throw Error("context '" + name + "': must be osmesa, egl or glfw");
}

const char* nameOf(ContextKind kind) {
  switch (kind) {
  case ContextKind::Osmesa:
    return "osmesa";
  case ContextKind::Egl:
    return "egl";
  case ContextKind::Glfw:
    return "glfw";
  }
  return "?";
}

ContextKind defaultContextKind() {
  static const bool isOsmesa = [] {
    const bool isInstalled = isOsmesaInstalled();
    if (!isInstalled) {
      say("context egl is used: libOSMesa is not installed");
    }
    return isInstalled;
  }();
  return isOsmesa ? ContextKind::Osmesa : ContextKind::Egl;
}

std::unique_ptr<Context> Context::create(ContextKind kind, const ContextOptions& options) {
  if (currentContext) {
    currentContext->releaseCurrent();
  }
  return begin(std::unique_ptr<Context>(new Context(kind, options.profile, createNative(kind, options))), options);
}

std::unique_ptr<Context> Context::adopt(Loader loader, std::function<void(bool)> setCurrent,
                                        const ContextOptions& options) {
  auto native = std::make_unique<AdoptedContext>(loader, std::move(setCurrent));
  return begin(std::unique_ptr<Context>(new Context(ContextKind::Glfw, options.profile, std::move(native))), options);
}

std::unique_ptr<Context> Context::begin(std::unique_ptr<Context> context, const ContextOptions& options) {
  context->makeCurrent();
  context->loadFunctions();
  if (options.debug) {
    context->collectMessages();
  }
  return context;
}

Context::Context(ContextKind kind, ContextProfile profile, std::unique_ptr<NativeContext> native)
    : kind_(kind), profile_(profile), native_(std::move(native)), functions_(std::make_unique<GladGLContext>()) {}

Context::~Context() { releaseCurrent(); }

void Context::loadFunctions() {
  const auto resolve = [](void* context, const char* name) {
    return reinterpret_cast<GLADapiproc>(static_cast<Context*>(context)->loader()(name));
  };
  const int version = gladLoadGLContextUserPtr(functions_.get(), resolve, this);
  if (version == 0) {
    throw Error(std::string("context ") + nameOf(kind_) + ": its OpenGL functions cannot be loaded");
  }
  glVersion_ = 10 * GLAD_VERSION_MAJOR(version) + GLAD_VERSION_MINOR(version);
  driver_ = glString(GL_VENDOR) + ", " + glString(GL_RENDERER) + ", OpenGL " + glString(GL_VERSION);
  if (profile_ == ContextProfile::Embedded) {
    loadEmbedded();
  } else if (glVersion_ < 33) {
    throw Error(std::string("context ") + nameOf(kind_) + ": needs OpenGL 3.3 core, but has " + driver_);
  }
}

// What OpenGL ES 3.2 has of later versions of OpenGL.
void Context::loadEmbedded() {
  const auto load = [this](auto& function, const char* name) {
    function = reinterpret_cast<std::decay_t<decltype(function)>>(loader()(name));
  };
  load(functions_->GenSamplers, "glGenSamplers");
  load(functions_->DeleteSamplers, "glDeleteSamplers");
  load(functions_->IsSampler, "glIsSampler");
  load(functions_->BindSampler, "glBindSampler");
  load(functions_->SamplerParameteri, "glSamplerParameteri");
  load(functions_->TexStorage2DMultisample, "glTexStorage2DMultisample");
  load(functions_->BlendFuncSeparatei, "glBlendFuncSeparatei");
  load(functions_->BlendEquationSeparatei, "glBlendEquationSeparatei");
}

void Context::collectMessages() {
  if (!functions_->DebugMessageCallback) {
    return;
  }
  functions_->Enable(GL_DEBUG_OUTPUT);
  functions_->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  functions_->DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  functions_->DebugMessageCallback(collectMessage, &messages_);
}

void Context::makeCurrent() {
  if (currentContext == this) {
    return;
  }
  // The libraries do not know of each other: each would take its last context for the current one.
  if (currentContext) {
    currentContext->releaseCurrent();
  }
  native_->bind();
  currentContext = this;
}

void Context::releaseCurrent() {
  if (currentContext == this) {
    native_->unbind();
    currentContext = nullptr;
  }
}

Context::Loader Context::loader() const { return native_->loader(); }

std::vector<std::string> Context::takeErrors() {
  constexpr int kMaxErrors = 16; // a context that is lost reports errors for ever
  Context* const previous = currentContext;
  makeCurrent();
  std::vector<std::string> errors = std::exchange(messages_, {});
  for (int i = 0; i < kMaxErrors; ++i) {
    const GLenum error = functions_->GetError();
    if (error == GL_NO_ERROR) {
      break;
    }
    errors.push_back(nameOfError(error));
  }
  if (previous != this) {
    releaseCurrent();
    if (previous) {
      previous->makeCurrent();
    }
  }
  return errors;
}

} // namespace host
