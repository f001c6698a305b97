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

constexpr ImU32 kHandle = IM_COL32(255, 235, 160, 255); ///< the colour of what can be dragged

/// A point of the picture, from (0, 0) at its left bottom to (1, 1), in the window, and back.
inline ImVec2 inWindow(const Area& area, const glm::dvec3& at) {
  return {area.x + static_cast<float>(at.x) * area.width, area.y + static_cast<float>(1 - at.y) * area.height};
}
inline glm::dvec2 inPicture(const Area& area, const ImVec2& point) {
  return {(point.x - area.x) / area.width, 1 - (point.y - area.y) / area.height};
}

/// Draws the handles of lights and, if it may, drags them (Handles.cpp); whether the mouse is on one, or drags one.
bool dragLights(Session& session, const Area& area, bool mayGrip);
/// The same for the edge between A and B.
bool dragWipe(Session& session, const Area& area);
/// Around the mouse, with the values of its pixel.
void drawMagnifier(Session& session, const Area& area);

} // namespace viewer
