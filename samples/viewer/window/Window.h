// The viewer's window: GLFW, Dear ImGui, and what keys and mouse do.
#pragma once

#include "Panels.h"

#include <filesystem>
#include <memory>
#include <string>

struct GLFWwindow;

namespace viewer {

class Window {
public:
  /// Throws host::Error without a display or OpenGL 3.3. `reports`: in a debug context; its errors, lines that tell
  /// of mistakes, and whether there is something left to do go to standard error.
  explicit Window(bool reports = false);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Until it is closed. `scene`: to begin with, a scene or a state; empty: none. False: GL reported errors.
  bool run(const std::filesystem::path& scene);

private:
  void turn();
  void takeMessage();
  void reportErrors();
  void reportRest(bool rests);
  void setScale(float scale);
  void setCallbacks();
  void wake() { framesToDraw_ = 3; }
  void open(const std::filesystem::path& file);
  void key(int key, int mods);
  void control(int key);
  void scroll(double steps);
  void waitForEvents(Activity activity);
  void layOut();
  void drawInterface(int unknownPress = -1); ///< as if that button were not down
  void drawFrame(int unknownPress);
  void lookCloser();
  void drawPicture();
  void drawStatus();
  void drawPanel();
  void takeFile(const std::filesystem::path& file);
  void navigate();
  void blink();
  void keepLayout() const;

  // Pictures are drawn in a context of their own, which shares its textures: the window may be drawn in the middle of
  // one, whatever GL's state is then.
  GLFWwindow *window_ = nullptr, *workshop_ = nullptr; ///< of the workshop nothing is seen
  std::unique_ptr<host::Context> screen_, drawing_;    ///< theirs; the latter is current but in drawInterface()
  std::unique_ptr<Viewer> viewer_;
  std::unique_ptr<Session> session_;
  float scale_ = 1;      ///< of the interface, by the display
  float panelWidth_ = 0; ///< in window units, 0 while hidden
  bool showsPanel_ = true;
  bool reports_ = false, hasErrors_ = false, rests_ = false;
  std::optional<glm::dvec2> cursor_; ///< of the last event
  bool isFlying_ = false;            ///< a key is down
  bool isHandled_ = false;           ///< the mouse drags a handle, not the view
  double lastFlight_ = 0;
  int framesToDraw_ = 3; ///< Dear ImGui takes some to come to rest
  double lastDrawn_ = 0;
};

} // namespace viewer
