// A window of OGRE's with shafts: its scene, its shadow maps, its compositor, and Tyndall as a pass of that. F switches
// the shafts off and on, the arrows turn the camera, Escape ends.
#include "Recorder.h"
#include "Scene.h"
#include "TyndallPass.h"

#define GLFW_INCLUDE_NONE
#include <CLI/CLI.hpp>
#include <GLFW/glfw3.h>
#include <chrono>
#include <iostream>

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

/// GLFW's window, its context, and OGRE's view of both.
class Window {
public:
  explicit Window(const Options& options) {
#ifdef GLFW_PLATFORM
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11); // OGRE's contexts are GLX's
#endif
    if (!glfwInit()) throw std::runtime_error("GLFW does not start: is there an X server?");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    window_ = glfwCreateWindow(options.width, options.height, "Tyndall in OGRE", nullptr, nullptr);
    if (!window_) throw std::runtime_error("no window with OpenGL 4.3");
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);
    glfwMakeContextCurrent(window_);
  }
  ~Window() { glfwTerminate(); }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* glfw() { return window_; }
  bool pressed(int key) { return glfwGetKey(window_, key) == GLFW_PRESS; }

private:
  GLFWwindow* window_ = nullptr;
};

Ogre::RenderWindow* openOgre(Ogre::Root& root, const Options& options) {
  for (const char* plugin : {"RenderSystem_GL3Plus", "Codec_STBI"})
    root.loadPlugin(std::string(TYNDALL_OGRE_PLUGINS "/") + plugin);
  root.setRenderSystem(root.getAvailableRenderers().front());
  root.initialise(false);
  const Ogre::NameValuePairList ofGlfw = {{"currentGLContext", "true"}, {"externalGLControl", "true"}};
  Ogre::RenderWindow* window = root.createRenderWindow("window", static_cast<unsigned>(options.width),
                                                       static_cast<unsigned>(options.height), false, &ofGlfw);
  Ogre::ResourceGroupManager& resources = Ogre::ResourceGroupManager::getSingleton();
  resources.addResourceLocation(TYNDALL_OGRE_OWN_MEDIA "/ShadowVolume", "FileSystem"); // which all its shadows ask for
  resources.addResourceLocation(TYNDALL_OGRE_MEDIA, "FileSystem");
  return window;
}

tyndall::Medium haze() {
  tyndall::Medium medium;
  medium.constituents = {{{0.016F, 0.016F, 0.016F}, tyndall::Phase::HenyeyGreenstein, 0.5F}};
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

void run(const Options& options) {
  Window glfw(options);
  Ogre::LogManager log;
  log.createLog("", true, false, true)->setLogDetail(Ogre::LL_LOW);
  Ogre::Root root("", "", "");
  Ogre::RenderWindow* window = openOgre(root, options);

  TyndallPass tyndallPass([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
  tyndallPass.medium = haze();
  tyndallPass.enabled = options.mode != "off";
  tyndallPass.reuse = !options.noReuse;
  Recorder recorder(options.digests, options.inscatter);
  tyndallPass.adjust = [&](tyndall::Frame& frame) { recorder.wantOutputs(frame, options.mode == "shafts"); };
  Ogre::CompositorManager::getSingleton().registerCustomCompositionPass("tyndall", &tyndallPass);
  Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();

  Scene scene(root);
  const std::vector<Ogre::CompositorInstance*> compositors = addViewports(*window, scene, options.viewports);
  const auto start = std::chrono::steady_clock::now();
  for (int frame = 0; options.frames == 0 || frame < options.frames; ++frame) {
    glfwPollEvents();
    if (glfwWindowShouldClose(glfw.glfw()) || glfw.pressed(GLFW_KEY_ESCAPE)) break;
    int width = 0, height = 0;
    glfwGetFramebufferSize(glfw.glfw(), &width, &height);
    window->resize(static_cast<unsigned>(width), static_cast<unsigned>(height));
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    scene.moveTo(options.frames > 0 ? frame / 30.0 : passed.count());
    const bool last = frame + 1 == options.frames;
    if (last && options.exact) tyndallPass.settings.technique = tyndall::Technique::Exact;
    root.renderOneFrame();
    recorder.digest(*window, compositors);
    if (last && !options.picture.empty()) window->writeContentsToFile(options.picture);
    glfwSwapBuffers(glfw.glfw());
  }
  recorder.writeInscatter();
  if (tyndallPass.enabled)
    std::cout << "redrawn in the last frame: " << tyndallPass.effect().statistics().redrawnShare << '\n';
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("A window of OGRE's with Tyndall's shafts.");
  Options options;
  describe(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "tyndall-ogre: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
