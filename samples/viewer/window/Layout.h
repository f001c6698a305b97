// The window's size, kept from one run to the next.
#pragma once

namespace viewer {

inline constexpr float kPanelWidth = 380; ///< of a display without scaling

struct Layout {
  int width = 1280;
  int height = 720;
  bool showsPanel = true;
};

/// As it was kept in $XDG_CONFIG_HOME/tyndall/viewer.json (~/.config by default); the default where nothing is, or
/// nothing that can be used.
Layout loadLayout();
/// Where that cannot be written nothing is kept.
void saveLayout(const Layout& layout);

} // namespace viewer
