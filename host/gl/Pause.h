// A breath between the draws of what takes long.
#pragma once

#include <functional>

namespace host {

/// While it lives, the host's renderers call `between` from draw to draw in this thread, and divide draws of many
/// triangles. It leaves GL's state as it is; what it throws ends the drawing, and is thrown by the renderer.
class Pause {
public:
  explicit Pause(std::function<void()> between);
  ~Pause();
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

  static bool isWanted(); ///< for renderers: there is one
  static void take();     ///< for renderers: after a draw

private:
  std::function<void()> between_;
  Pause* outer_;
};

} // namespace host
