// Lights and shadow maps.
#include "Panels.h"
#include "Widgets.h"

#include <algorithm>

namespace viewer {

namespace {

/// Fields that mean nothing for a light of the kind, or are taken from the scene.
std::vector<std::string> hiddenFields(const settings::StateLight& light) {
  std::vector<std::string> hidden;
  const bool isSun = light.light.kind == tyndall::LightKind::Directional,
             isSpot = light.light.kind == tyndall::LightKind::Spot;
  if (isSun) hidden.insert(hidden.end(), {"position", "range"});
  if (!isSun) hidden.insert(hidden.end(), {"cascadeFade", "boundary.enabled", "boundary.point", "boundary.normal"});
  if (!isSpot) hidden.insert(hidden.end(), {"innerConeAngle", "outerConeAngle"});
  if (!isSun && !isSpot) hidden.emplace_back("direction");
  if (light.follows >= 0) hidden.insert(hidden.end(), {"position", "direction"});
  return hidden;
}

void keepCone(settings::StateLight& light, const std::string& edited) {
  tyndall::Light& it = light.light;
  if (edited == "innerConeAngle") it.outerConeAngle = std::max(it.outerConeAngle, it.innerConeAngle);
  if (edited == "outerConeAngle") it.innerConeAngle = std::min(it.innerConeAngle, it.outerConeAngle);
}

void drawList(Session& session, std::vector<settings::StateLight>& lights, std::string& edited) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Checkbox("##on", &lights[i].on)) edited = "on";
    ImGui::SameLine();
    const settings::Row& kind = settings::lightTable()["kind"];
    const std::string name =
        "light " + std::to_string(i) + ": " + textOf(kind, settings::lightTable()["kind"].get(lights[i]));
    if (ImGui::Selectable(name.c_str(), session.light == static_cast<int>(i))) session.light = static_cast<int>(i);
    ImGui::PopID();
  }
}

void addLight(Session& session, std::vector<settings::StateLight>& lights) {
  settings::StateLight light;
  const LookAt view = session.viewer.view();
  light.light.kind = tyndall::LightKind::Point;
  light.light.position = {view.target.x, view.target.y, view.target.z};
  const double distance = glm::length(view.target - view.eye);
  const auto intensity = static_cast<float>(std::clamp(distance * distance, 1e-6, 1e6));
  light.light.colour = {intensity, intensity, intensity};
  lights.push_back(light);
  session.light = static_cast<int>(lights.size()) - 1;
}

void drawMaps(Viewer& viewer, const char* name, const char* group, const settings::Table<settings::State>& table) {
  settings::State state = viewer.state();
  if (heading(name, isAtStart(table, state, settings::State()))) {
    for (const auto& row : table.rows)
      row.set(state, row.get(settings::State()));
    return viewer.edit(std::string("reset ") + group, state);
  }
  std::string field;
  if (editRows(table, state, settings::State(), field)) viewer.edit(std::string(group) + "." + field, state);
}

} // namespace

std::vector<settings::StateLight> editableLights(const Viewer& viewer) {
  if (!viewer.scene()) return {};
  host::Notes ofNoConcern;
  const std::vector<glm::dmat4> pose = host::poseAt(*viewer.scene(), viewer.state().seconds);
  const std::vector<tyndall::Light> scene = host::makeLights(*viewer.scene(), pose, ofNoConcern);
  if (const auto& own = viewer.state().lights) return settings::placed(*own, scene);
  std::vector<settings::StateLight> lights = settings::following(scene);
  for (settings::StateLight& light : lights)
    if (light.light.kind == tyndall::LightKind::Directional) light.light.cascadeFade = viewer.state().cascadeFade;
  return lights;
}

void drawLightPanel(Session& session) {
  Viewer& viewer = session.viewer;
  settings::State state = viewer.state();
  std::vector<settings::StateLight> lights = editableLights(viewer);
  std::string edited;
  if (heading("Lights", !state.lights)) {
    state.lights.reset();
    return viewer.edit("reset lights", state);
  }
  drawList(session, lights, edited);
  session.light = std::clamp(session.light, 0, std::max(0, static_cast<int>(lights.size()) - 1));
  ImGui::BeginDisabled(lights.size() >= tyndall::kMaxLights || !viewer.scene());
  if (ImGui::SmallButton("add")) {
    addLight(session, lights);
    edited = "add";
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(lights.empty());
  if (ImGui::SmallButton("remove")) {
    lights.erase(lights.begin() + session.light);
    edited = "remove";
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::TextDisabled("drag the handles in the picture");
  if (edited.empty() && !lights.empty()) {
    settings::StateLight& light = lights[static_cast<std::size_t>(session.light)];
    std::vector<std::string> hidden = hiddenFields(light);
    hidden.emplace_back("on");
    ImGui::Separator();
    editRows(settings::lightTable(), light, settings::StateLight(), edited, hidden);
    keepCone(light, edited);
  }
  if (!edited.empty()) {
    state.lights = lights;
    viewer.edit("lights[" + std::to_string(session.light) + "]." + edited, state);
  }
  drawMaps(viewer, "Shadow maps", "maps", settings::mapsTable());
  if (viewer.hasVolumes()) drawMaps(viewer, "Smoke and strands", "volumes", settings::volumesTable());
}

} // namespace viewer
