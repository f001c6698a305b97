// OpenGL contexts without a window: OSMesa, surfaceless EGL and a hidden GLFW window, chosen at run time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

struct GladGLContext;

namespace host {

class NativeContext;

enum class ContextKind { Osmesa, Egl, Glfw };

/// "osmesa", "egl" or "glfw"; anything else throws host::Error.
ContextKind parseContextKind(const std::string& name);
const char* nameOf(ContextKind kind);

bool isOsmesaInstalled(); ///< Mesa has not had it since version 25.1

/// Of whoever needs no screen and names no kind: OSMesa or, which is said once on standard error, EGL where it is
/// missing.
ContextKind defaultContextKind();

/// Compatibility: what old engines have, with all of OpenGL 1 still in it.
/// Embedded: OpenGL ES 3.2, by EGL.
enum class ContextProfile { Core, Compatibility, Embedded };

struct ContextOptions {
  bool debug = true; ///< collect the driver's debug messages, synchronously
  ContextProfile profile = ContextProfile::Core;
};

/// A core profile, or what the options say, 4.5 if there is one, at least 3.3. Contexts of one or several kinds may
/// live side by side; the host keeps track of which one is current in a thread, so switch between them only with
/// makeCurrent().
class Context {
public:
  using Loader = void* (*)(const char* name);

  /// The new context is current on return. Throws host::Error with one line if there is none to be had.
  static std::unique_ptr<Context> create(ContextKind kind, const ContextOptions& options = {});
  /// For a context of a window that the caller has made: setCurrent(true) makes it current in this thread, with false
  /// none is. Current on return.
  static std::unique_ptr<Context> adopt(Loader loader, std::function<void(bool)> setCurrent,
                                        const ContextOptions& options = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void makeCurrent();
  void releaseCurrent(); ///< does nothing if another context is current

  Loader loader() const; ///< resolves GL functions by name while this context is current
  ContextKind kind() const { return kind_; }
  ContextProfile profile() const { return profile_; }
  int glVersion() const { return glVersion_; }                   ///< 10 major + minor
  const std::string& driver() const { return driver_; }          ///< vendor, renderer and version
  const GladGLContext& functions() const { return *functions_; } ///< what gl() gives while this context is current

  /// GL errors and debug messages that are errors or of high severity since the last call, oldest first; shader logs
  /// are not among them.
  std::vector<std::string> takeErrors();

private:
  Context(ContextKind kind, ContextProfile profile, std::unique_ptr<NativeContext> native);
  static std::unique_ptr<Context> begin(std::unique_ptr<Context> context, const ContextOptions& options);
  void loadFunctions();
  void loadEmbedded();
  void collectMessages();

  ContextKind kind_;
  ContextProfile profile_;
  std::unique_ptr<NativeContext> native_;
  std::unique_ptr<GladGLContext> functions_;
  std::string driver_;
  int glVersion_ = 0;
  std::vector<std::string> messages_;
};

} // namespace host
