#include "Picture.h"
#include "Widgets.h"

#include <algorithm>
#include <cmath>

namespace viewer {

bool dragWipe(Session& session, const Area& area) {
  static bool isDragged = false;
  if (!session.viewer.second()) return isDragged = false;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float edge = area.x + session.viewer.shownAs().wipe * area.width;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine(ImVec2(edge, area.y), ImVec2(edge, area.y + area.height), kHandle, 2);
  const float line = ImGui::GetTextLineHeight();
  list.AddText(ImVec2(std::max(edge - line, area.x), area.y + 4), kHandle, "A");
  list.AddText(ImVec2(edge + 6, area.y + 4), kHandle, "B");
  const bool isOver = std::abs(mouse.x - edge) < 6 && area.holds(mouse) && !ImGui::GetIO().WantCaptureMouse;
  if (isOver && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) isDragged = true;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) isDragged = false;
  if (isDragged) session.viewer.setWipe(std::clamp((mouse.x - area.x) / area.width, 0.0F, 1.0F));
  return isOver || isDragged;
}

void drawMagnifier(Session& session, const Area& area) {
  constexpr float kSide = 144, kTimes = 12;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  Viewer& viewer = session.viewer;
  if (!session.hasMagnifier || !viewer.scene() || !area.holds(mouse) || ImGui::GetIO().WantCaptureMouse) return;
  const glm::dvec2 at = inPicture(area, mouse);
  const Viewer::PixelValues& values = session.magnified;
  const float halfWidth = 0.5F * kSide / kTimes / area.width, halfHeight = 0.5F * kSide / kTimes / area.height;
  const auto u = static_cast<float>(at.x), v = static_cast<float>(at.y);
  ImGui::BeginTooltip();
  ImGui::Image(imageOf(viewer.picture()), ImVec2(kSide, kSide), ImVec2(u - halfWidth, v + halfHeight),
               ImVec2(u + halfWidth, v - halfHeight));
  ImGui::Text("pixel %d, %d", values.x, values.y);
  ImGui::Text("inscatter %.4g %.4g %.4g", static_cast<double>(values.inscatter[0]),
              static_cast<double>(values.inscatter[1]), static_cast<double>(values.inscatter[2]));
  ImGui::Text("transmittance %.4g %.4g %.4g", static_cast<double>(values.transmittance[0]),
              static_cast<double>(values.transmittance[1]), static_cast<double>(values.transmittance[2]));
  if (std::isfinite(values.distance))
    ImGui::Text("distance %.4g", values.distance);
  else
    ImGui::TextUnformatted("distance: sky");
  ImGui::EndTooltip();
}

} // namespace viewer
