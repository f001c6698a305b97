#include "Picture.h"
#include "Widgets.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

constexpr float kRadius = 8; ///< of a handle
constexpr ImU32 kHandle = IM_COL32(255, 235, 160, 255), kDark = IM_COL32(0, 0, 0, 200);

ImVec2 inWindow(const Area& area, const glm::dvec3& at) {
  return {area.x + static_cast<float>(at.x) * area.width, area.y + static_cast<float>(1 - at.y) * area.height};
}

glm::dvec2 inPicture(const Area& area, const ImVec2& point) {
  return {(point.x - area.x) / area.width, 1 - (point.y - area.y) / area.height};
}

/// A sun's handle is on a ball around the middle of the view, where its light comes from.
struct Ball {
  glm::dvec3 middle;
  double radius;
};

Ball ballOf(const LookAt& view) { return {view.target, 0.3 * glm::length(view.target - view.eye)}; }

glm::dvec3 placeOf(const tyndall::Light& light, const LookAt& view) {
  if (light.kind != tyndall::LightKind::Directional) return {light.position[0], light.position[1], light.position[2]};
  const Ball ball = ballOf(view);
  return ball.middle -
         ball.radius * glm::normalize(glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
}

/// The light with its handle at this point of the picture: as far from the eye as before, or on the ball.
void place(tyndall::Light& light, const LookAt& view, const Area& area, const ImVec2& mouse) {
  const glm::dvec3 ray = rayOf(view, area.aspect(), inPicture(area, mouse));
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  if (light.kind != tyndall::LightKind::Directional) {
    const double depth = projected(view, area.aspect(), placeOf(light, view)).z;
    const glm::dvec3 to = view.eye + ray * (depth / glm::dot(ray, forward));
    light.position = {to.x, to.y, to.z};
    return;
  }
  const Ball ball = ballOf(view);
  const glm::dvec3 from = view.eye - ball.middle;
  const double along = glm::dot(ray, from), square = along * along - glm::dot(from, from) + ball.radius * ball.radius;
  const bool isBehind = glm::dot(placeOf(light, view) - ball.middle, forward) > 0;
  const double root = std::sqrt(std::max(square, 0.0)) * (isBehind ? 1 : -1);
  const glm::dvec3 to = glm::normalize(from + ray * (-along + root));
  light.direction = {-to.x, -to.y, -to.z};
}

void drawHandle(const ImVec2& at, const tyndall::Light& light, bool isChosen, const Area& area) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(ImVec2(area.x, area.y), ImVec2(area.x + area.width, area.y + area.height));
  const float peak = std::max({light.colour[0], light.colour[1], light.colour[2], 1e-20F});
  const ImU32 colour =
      ImGui::ColorConvertFloat4ToU32(ImVec4(light.colour[0] / peak, light.colour[1] / peak, light.colour[2] / peak, 1));
  list.AddCircleFilled(at, kRadius, kDark);
  list.AddCircleFilled(at, kRadius - 3, colour);
  list.AddCircle(at, kRadius + (isChosen ? 3 : 0), kHandle, 0, isChosen ? 2.5F : 1.5F);
  list.PopClipRect();
}

} // namespace

bool dragLights(Session& session, const Area& area) {
  static int dragged = -1;
  Viewer& viewer = session.viewer;
  if (!viewer.scene()) return false;
  std::vector<settings::StateLight> lights = editableLights(viewer);
  const LookAt view = viewer.view();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (dragged >= 0) viewer.endEdit();
    dragged = -1;
  }
  bool isOver = dragged >= 0;
  for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
    settings::StateLight& light = lights[static_cast<std::size_t>(i)];
    if (!light.on) continue;
    const glm::dvec3 at = projected(view, area.aspect(), placeOf(light.light, view));
    if (at.z <= 0) continue;
    const ImVec2 handle = inWindow(area, at);
    drawHandle(handle, light.light, i == session.light, area);
    const bool isNear = std::hypot(handle.x - mouse.x, handle.y - mouse.y) < kRadius + 3;
    if (!isNear || !area.holds(mouse) || ImGui::GetIO().WantCaptureMouse) continue;
    isOver = true;
    if (dragged < 0 && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) session.light = dragged = i;
  }
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (dragged < 0 || dragged >= static_cast<int>(lights.size()) || (moved.x == 0 && moved.y == 0)) return isOver;
  settings::StateLight& light = lights[static_cast<std::size_t>(dragged)];
  light.follows = -1;
  place(light.light, view, area, mouse);
  settings::State state = viewer.state();
  state.lights = lights;
  viewer.edit("drag light " + std::to_string(dragged), state);
  return true;
}

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
