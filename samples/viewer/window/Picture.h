// The picture in the window: handles of lights, the wipe's edge, the magnifier.
#pragma once

#include "Panels.h"

#include <imgui.h>

namespace viewer {

/// Where the picture is, in window units from the left top.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
  bool holds(const ImVec2& point) const {
    return point.x >= x && point.y >= y && point.x < x + width && point.y < y + height;
  }
  float aspect() const { return width / height; }
};

/// Draws the handles and drags them; whether the mouse is on one, or drags one.
bool dragLights(Session& session, const Area& area);
/// The same for the edge between A and B.
bool dragWipe(Session& session, const Area& area);
/// Around the mouse, with the values of its pixel.
void drawMagnifier(Session& session, const Area& area);

} // namespace viewer
