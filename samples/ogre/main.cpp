// A window of OGRE's with shafts: its scene, its shadow maps, its compositor, and Tyndall as a pass of that. While
// Space is down there are none; the arrows turn the first camera; Escape ends.
#include "Recorder.h"
#include "Scene.h"
#include "TyndallPass.h"

#define GLFW_INCLUDE_NONE
#include <CLI/CLI.hpp>
#include <GL/glx.h>
#include <GLFW/glfw3.h>
#include <chrono>
#include <cstdio>
#include <iostream>

/// Of <GLFW/glfw3native.h>, which wants headers of Xrandr.
extern "C" Window glfwGetX11Window(GLFWwindow* window);

namespace {

struct Options {
  int frames = 0;
  int width = 960, height = 540;
  int viewports = 1;
  std::string mode = "shafts";
  bool exact = false, noReuse = false;
  std::string digests, inscatter, picture;
};

void describe(CLI::App& app, Options& options) {
  app.add_option("--frames", options.frames, "end after so many, 1/30 s apart, whatever they take; 0: at Escape");
  app.add_option("--width", options.width, "pixels of the window");
  app.add_option("--height", options.height);
  app.add_option("--viewports", options.viewports, "1, or 2 side by side")->check(CLI::Range(1, 2));
  app.add_option("--mode", options.mode, "shafts; outputs: into textures that nobody shows; off")
      ->check(CLI::IsMember({"shafts", "outputs", "off"}));
  app.add_flag("--exact", options.exact, "the last frame by Technique::Exact, to compare with");
  app.add_flag("--no-reuse", options.noReuse, "draw every frame in full");
  app.add_option("--digests", options.digests, "file for a line a frame: hashes of OGRE's pictures");
  app.add_option("--inscatter", options.inscatter, "file for the last frame's inscatter, in floats");
  app.add_option("--picture", options.picture, "PNG file for the last frame");
}

/// GLFW's window, in which OGRE's is: resizes and keys are GLFW's, the context is OGRE's.
class OuterWindow {
public:
  explicit OuterWindow(const Options& options) {
#ifdef GLFW_PLATFORM
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11); // OGRE's contexts are GLX's
#endif
    if (!glfwInit()) throw std::runtime_error("GLFW does not start: is there an X server?");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(options.width, options.height, "Tyndall in OGRE", nullptr, nullptr);
    if (!window_) throw std::runtime_error("GLFW has no window for us");
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);
  }
  ~OuterWindow() { glfwTerminate(); }
  OuterWindow(const OuterWindow&) = delete;
  OuterWindow& operator=(const OuterWindow&) = delete;

  bool pressed(int key) { return glfwGetKey(window_, key) == GLFW_PRESS; }
  bool closed() { return glfwWindowShouldClose(window_) || pressed(GLFW_KEY_ESCAPE); }
  std::string handle() { return std::to_string(glfwGetX11Window(window_)); }
  void resize(Ogre::RenderWindow& inner) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    inner.resize(static_cast<unsigned>(width), static_cast<unsigned>(height));
    inner.windowMovedOrResized();
  }

private:
  GLFWwindow* window_ = nullptr;
};

Ogre::RenderWindow* openOgre(Ogre::Root& root, const Options& options, const std::string& parent) {
  for (const char* plugin : {"RenderSystem_GL3Plus", "Codec_STBI"})
    root.loadPlugin(std::string(TYNDALL_OGRE_PLUGINS "/") + plugin);
  root.setRenderSystem(root.getAvailableRenderers().front());
  root.initialise(false);
  const Ogre::NameValuePairList inside = {{"parentWindowHandle", parent}};
  Ogre::RenderWindow* window = root.createRenderWindow("window", static_cast<unsigned>(options.width),
                                                       static_cast<unsigned>(options.height), false, &inside);
  Ogre::ResourceGroupManager& resources = Ogre::ResourceGroupManager::getSingleton();
  resources.addResourceLocation(TYNDALL_OGRE_OWN_MEDIA "/ShadowVolume", "FileSystem"); // which all its shadows ask for
  resources.addResourceLocation(TYNDALL_OGRE_MEDIA, "FileSystem");
  return window;
}

/// Calls before the picture is shown, when it can be read.
struct BeforeShown final : Ogre::FrameListener {
  std::function<void()> call;
  bool frameRenderingQueued(const Ogre::FrameEvent& /*event*/) override {
    call();
    return true;
  }
};

tyndall::Medium haze() {
  tyndall::Medium medium;
  medium.constituents = {{{0.018F, 0.018F, 0.018F}, tyndall::Phase::HenyeyGreenstein, 0.5F}};
  medium.farDistance = 40;
  return medium;
}

/// Viewports side by side, each with a camera and the compositor of media/demo.compositor.
std::vector<Ogre::CompositorInstance*> addViewports(Ogre::RenderWindow& window, Scene& scene, int count) {
  std::vector<Ogre::CompositorInstance*> compositors;
  Ogre::CompositorManager& manager = Ogre::CompositorManager::getSingleton();
  for (int i = 0; i < count; ++i) {
    const float share = 1 / static_cast<float>(count);
    Ogre::Viewport* viewport = window.addViewport(scene.addCamera(i), i, share * static_cast<float>(i), 0, share, 1);
    compositors.push_back(manager.addCompositor(viewport, "Demo"));
    manager.setCompositorEnabled(viewport, "Demo", true);
  }
  return compositors;
}

/// By what arrows are down.
void turn(Ogre::Camera& camera, OuterWindow& keys) {
  const int left = keys.pressed(GLFW_KEY_LEFT) - keys.pressed(GLFW_KEY_RIGHT);
  const int up = keys.pressed(GLFW_KEY_UP) - keys.pressed(GLFW_KEY_DOWN);
  if (left != 0) camera.getParentSceneNode()->yaw(Ogre::Degree(2 * static_cast<float>(left)), Ogre::Node::TS_WORLD);
  if (up != 0) camera.getParentSceneNode()->pitch(Ogre::Degree(2 * static_cast<float>(up)));
}

void run(const Options& options) {
  OuterWindow outer(options);
  Ogre::LogManager log;
  log.createLog("", true, true, true)->setLogDetail(Ogre::LL_LOW);
  Ogre::Root root("", "", "");
  Ogre::RenderWindow* window = openOgre(root, options, outer.handle());

  TyndallPass tyndallPass([](const char* name) {
    return reinterpret_cast<void*>(glXGetProcAddressARB(reinterpret_cast<const GLubyte*>(name)));
  });
  tyndallPass.medium = haze();
  tyndallPass.reuse = !options.noReuse;
  Recorder recorder(options.digests, options.inscatter);
  tyndallPass.adjust = [&](tyndall::Frame& frame) { recorder.wantOutputs(frame, options.mode == "shafts"); };
  Ogre::CompositorManager::getSingleton().registerCustomCompositionPass("tyndall", &tyndallPass);
  Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();

  Scene scene(root);
  const std::vector<Ogre::CompositorInstance*> compositors = addViewports(*window, scene, options.viewports);
  bool last = false;
  BeforeShown recording;
  recording.call = [&] {
    recorder.digest(*window, compositors);
    if (last && !options.picture.empty()) window->writeContentsToFile(options.picture);
  };
  root.addFrameListener(&recording);

  const auto start = std::chrono::steady_clock::now();
  for (int frame = 0; !last; ++frame) {
    glfwPollEvents();
    if (outer.closed()) break;
    last = frame + 1 == options.frames;
    outer.resize(*window);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    scene.moveTo(options.frames > 0 ? frame / 30.0 : passed.count());
    turn(*window->getViewport(0)->getCamera(), outer);
    tyndallPass.enabled = options.mode != "off" && !outer.pressed(GLFW_KEY_SPACE);
    if (last && options.exact) tyndallPass.settings.technique = tyndall::Technique::Exact;
    root.renderOneFrame();
  }
  recorder.writeInscatter();
  if (tyndallPass.enabled)
    std::cout << "redrawn in the last frame: " << tyndallPass.effect().statistics().redrawnShare << '\n';
}

} // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("A window of OGRE's with Tyndall's shafts.");
    Options options;
    describe(app, options);
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ogre-shafts: %s\n", error.what());
    return 1;
  }
}
