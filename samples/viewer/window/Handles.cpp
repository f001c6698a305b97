// Lights are dragged by their handles: place, direction, cone and range.
#include "Picture.h"
#include "Widgets.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

constexpr float kRadius = 8; ///< of a handle
constexpr ImU32 kDark = IM_COL32(0, 0, 0, 200), kFaint = IM_COL32(255, 235, 160, 120);

/// A sun's handle is on a ball around the middle of the view, where its light comes from.
struct Ball {
  glm::dvec3 middle;
  double radius;
};

Ball ballOf(const LookAt& view) { return {view.target, 0.3 * glm::length(view.target - view.eye)}; }

glm::dvec3 vectorOf(const tyndall::Vec3& v) { return {v[0], v[1], v[2]}; }
tyndall::Vec3 arrayOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 directionOf(const tyndall::Light& light) { return glm::normalize(vectorOf(light.direction)); }

glm::dvec3 placeOf(const tyndall::Light& light, const LookAt& view) {
  if (light.kind != tyndall::LightKind::Directional) return vectorOf(light.position);
  const Ball ball = ballOf(view);
  return ball.middle - ball.radius * directionOf(light);
}

/// How far along its axis a spot's handles are.
double reachOf(const tyndall::Light& light, const LookAt& view) {
  constexpr double kShare = 0.35; // of the way to what is looked at
  return std::min(light.range, kShare * glm::length(view.target - view.eye));
}

/// Across a light's axis, as it is seen.
glm::dvec3 sideOf(const tyndall::Light& light, const LookAt& view) {
  const glm::dvec3 across = glm::cross(directionOf(light), vectorOf(light.position) - view.eye);
  return glm::length(across) > 0 ? glm::normalize(across) : glm::dvec3(1, 0, 0);
}

/// Where a grip is; none: the light has no such.
std::optional<glm::dvec3> placeOf(Grip::What what, const tyndall::Light& light, const LookAt& view) {
  const bool isSpot = light.kind == tyndall::LightKind::Spot;
  const bool hasRange = light.kind != tyndall::LightKind::Directional && std::isfinite(light.range);
  switch (what) {
  case Grip::What::Place:
    return placeOf(light, view);
  case Grip::What::Target:
    if (isSpot) return vectorOf(light.position) + reachOf(light, view) * directionOf(light);
    break;
  case Grip::What::Cone:
    if (isSpot)
      return vectorOf(light.position) + reachOf(light, view) * (std::cos(light.outerConeAngle) * directionOf(light) +
                                                                std::sin(light.outerConeAngle) * sideOf(light, view));
    break;
  case Grip::What::Range:
    if (hasRange) {
      const glm::dvec3 right = glm::cross(view.target - view.eye, glm::dvec3(0, 1, 0));
      return vectorOf(light.position) + light.range * glm::normalize(right);
    }
    break;
  }
  return std::nullopt;
}

/// The point under the mouse as far into the picture as another one.
glm::dvec3 atDepthOf(const glm::dvec3& place, const LookAt& view, const Area& area, const ImVec2& mouse) {
  const glm::dvec3 ray = rayOf(view, area.aspect(), inPicture(area, mouse));
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  return view.eye + ray * (projected(view, area.aspect(), place).z / glm::dot(ray, forward));
}

/// On the ball, on its side that the sun is on.
glm::dvec3 onBall(const tyndall::Light& sun, const LookAt& view, const Area& area, const ImVec2& mouse) {
  const glm::dvec3 ray = rayOf(view, area.aspect(), inPicture(area, mouse));
  const Ball ball = ballOf(view);
  const glm::dvec3 from = view.eye - ball.middle;
  const double along = glm::dot(ray, from), square = along * along - glm::dot(from, from) + ball.radius * ball.radius;
  const bool isBehind = glm::dot(placeOf(sun, view) - ball.middle, view.target - view.eye) > 0;
  const double root = std::sqrt(std::max(square, 0.0)) * (isBehind ? 1 : -1);
  return glm::normalize(from + ray * (-along + root));
}

/// The light with its grip under the mouse.
void drag(Grip::What what, tyndall::Light& light, const LookAt& view, const Area& area, const ImVec2& mouse) {
  constexpr double kRightAngle = 1.5707963267948966, kLeastAngle = 0.01;
  if (what == Grip::What::Place && light.kind == tyndall::LightKind::Directional) {
    light.direction = arrayOf(-onBall(light, view, area, mouse));
    return;
  }
  const glm::dvec3 place = vectorOf(light.position);
  const glm::dvec3 to = atDepthOf(*placeOf(what, light, view), view, area, mouse), way = to - place;
  const double length = glm::length(way);
  if (!std::isfinite(length)) return;
  if (what == Grip::What::Place) light.position = arrayOf(to);
  if (!(length > 0)) return;
  if (what == Grip::What::Target) light.direction = arrayOf(way / length);
  if (what == Grip::What::Range) light.range = length;
  if (what != Grip::What::Cone) return;
  const double angle = std::acos(std::clamp(glm::dot(way / length, directionOf(light)), -1.0, 1.0));
  const double share = light.outerConeAngle > 0 ? light.innerConeAngle / light.outerConeAngle : 0;
  light.outerConeAngle = std::clamp(angle, kLeastAngle, kRightAngle);
  light.innerConeAngle = share * light.outerConeAngle;
}

void drawHandle(const ImVec2& at, const tyndall::Light& light, Grip::What what, bool isChosen) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  if (what != Grip::What::Place) {
    list.AddRectFilled(ImVec2(at.x - 5, at.y - 5), ImVec2(at.x + 5, at.y + 5), kDark);
    list.AddRect(ImVec2(at.x - 5, at.y - 5), ImVec2(at.x + 5, at.y + 5), kHandle, 0, 0, 1.5F);
    return;
  }
  const float peak = std::max({light.colour[0], light.colour[1], light.colour[2], 1e-20F});
  const ImU32 colour =
      ImGui::ColorConvertFloat4ToU32(ImVec4(light.colour[0] / peak, light.colour[1] / peak, light.colour[2] / peak, 1));
  list.AddCircleFilled(at, kRadius, kDark);
  list.AddCircleFilled(at, kRadius - 3, colour);
  list.AddCircle(at, kRadius + (isChosen ? 3 : 0), kHandle, 0, isChosen ? 2.5F : 1.5F);
}

const char* nameOf(Grip::What what, const tyndall::Light& light) {
  const bool isSun = light.kind == tyndall::LightKind::Directional;
  switch (what) {
  case Grip::What::Place:
    return isSun ? "direction" : "position";
  case Grip::What::Target:
    return "direction";
  case Grip::What::Cone:
    return "outerConeAngle";
  case Grip::What::Range:
    return "range";
  }
  return "";
}

/// The circle around a light's axis, or around a lamp, that a grip is on.
void drawOutline(const tyndall::Light& light, Grip::What what, const LookAt& view, const Area& area) {
  constexpr int kPoints = 48;
  const glm::dvec3 place = vectorOf(light.position);
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  glm::dvec3 middle = place, axis = forward;
  double radius = light.range;
  if (what == Grip::What::Cone) {
    axis = directionOf(light);
    middle = place + reachOf(light, view) * std::cos(light.outerConeAngle) * axis;
    radius = reachOf(light, view) * std::sin(light.outerConeAngle);
  }
  const glm::dvec3 aside = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, aside)), v = glm::cross(axis, u);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto line = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 a = projected(view, area.aspect(), from), b = projected(view, area.aspect(), to);
    if (a.z > 0 && b.z > 0) list.AddLine(inWindow(area, a), inWindow(area, b), kFaint);
  };
  const auto at = [&](int i) {
    const double angle = 6.283185307179586 * i / kPoints;
    return middle + radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  for (int i = 0; i < kPoints; ++i) {
    line(at(i), at(i + 1));
    if (what == Grip::What::Cone && i % (kPoints / 4) == 0) line(place, at(i));
  }
}

/// Which grips a light shows: all if it is chosen.
std::vector<Grip::What> gripsOf(bool isChosen) {
  if (!isChosen) return {Grip::What::Place};
  return {Grip::What::Range, Grip::What::Cone, Grip::What::Target, Grip::What::Place};
}

} // namespace

bool dragLights(Session& session, const Area& area, bool mayGrip) {
  Viewer& viewer = session.viewer;
  if (!viewer.scene() || !session.hasHandles) return false;
  std::vector<settings::StateLight> lights = editableLights(viewer);
  const LookAt view = viewer.view();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (session.dragged) viewer.endEdit();
    session.dragged.reset();
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(ImVec2(area.x, area.y), ImVec2(area.x + area.width, area.y + area.height));
  std::optional<Grip> under;
  for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
    const settings::StateLight& light = lights[static_cast<std::size_t>(i)];
    if (!light.on) continue;
    for (const Grip::What what : gripsOf(i == session.light)) {
      const std::optional<glm::dvec3> place = placeOf(what, light.light, view);
      if (!place) continue;
      const glm::dvec3 at = projected(view, area.aspect(), *place);
      if (what == Grip::What::Cone || what == Grip::What::Range) drawOutline(light.light, what, view, area);
      if (at.z <= 0) continue;
      const ImVec2 handle = inWindow(area, at);
      drawHandle(handle, light.light, what, i == session.light);
      if (std::hypot(handle.x - mouse.x, handle.y - mouse.y) < kRadius + 3) under = Grip{what, i};
    }
  }
  list.PopClipRect();
  if (!mayGrip || !area.holds(mouse) || ImGui::GetIO().WantCaptureMouse) under.reset();
  if (under && !session.dragged) {
    const tyndall::Light& light = lights[static_cast<std::size_t>(under->light)].light;
    ImGui::SetTooltip("light %d: %s", under->light, nameOf(under->what, light));
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      session.dragged = under;
      session.light = under->light;
    }
  }
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  const bool isDragged = session.dragged && session.dragged->light < static_cast<int>(lights.size());
  if (!isDragged || (moved.x == 0 && moved.y == 0)) return under || session.dragged;
  settings::StateLight& light = lights[static_cast<std::size_t>(session.dragged->light)];
  if (!placeOf(session.dragged->what, light.light, view)) return true;
  const Grip::What what = session.dragged->what;
  if (what == Grip::What::Place || what == Grip::What::Target) light.follows = -1;
  drag(session.dragged->what, light.light, view, area, mouse);
  settings::State state = viewer.state();
  state.lights = lights;
  viewer.edit("drag light " + std::to_string(session.dragged->light) + "'s " +
                  nameOf(session.dragged->what, light.light),
              state);
  return true;
}

} // namespace viewer
