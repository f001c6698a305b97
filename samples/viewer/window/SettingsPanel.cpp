// How the effect works, and how its picture is shown.
#include "Panels.h"
#include "Widgets.h"

namespace viewer {

namespace {

void drawProfiles(Viewer& viewer) {
  settings::State state = viewer.state();
  for (const settings::Choice& profile : settings::kProfiles) {
    const auto value = static_cast<tyndall::Profile>(profile.value);
    if (profile.value > 0) ImGui::SameLine();
    if (!ImGui::RadioButton(profile.enumerator, state.profile == value)) continue;
    const tyndall::DebugView view = state.settings.debugView;
    state.profile = value;
    state.settings = tyndall::settingsOf(value);
    state.settings.debugView = view;
    viewer.edit("profile " + std::string(profile.name), state);
  }
}

/// A group of the state with its heading.
template <typename Owner, typename Part>
void drawGroup(Viewer& viewer, const char* name, const char* group, const settings::Table<Owner>& table,
               const Owner& start, const Part& partOf, const std::vector<std::string>& hidden = {}) {
  settings::State state = viewer.state();
  if (heading(name, isAtStart(table, partOf(state), start, hidden))) {
    for (const auto& row : table.rows)
      if (!isAmong(hidden, row.field)) row.set(partOf(state), row.get(start));
    return viewer.edit(std::string("reset ") + group, state);
  }
  std::string field;
  if (editRows(table, partOf(state), start, field, hidden)) viewer.edit(std::string(group) + "." + field, state);
}

} // namespace

void drawSettingsPanel(Session& session) {
  Viewer& viewer = session.viewer;
  drawProfiles(viewer);
  drawGroup(viewer, "Settings", "settings", settings::settingsTable(), tyndall::settingsOf(viewer.state().profile),
            [](settings::State& s) -> tyndall::Settings& { return s.settings; });
  drawGroup(viewer, "Tuning", "tuning", settings::tuningTable(), tyndall::Tuning(),
            [](settings::State& s) -> tyndall::Tuning& { return s.tuning; });
  drawGroup(viewer, "Reuse", "reuse", settings::reuseTable(), tyndall::Reuse(),
            [](settings::State& s) -> tyndall::Reuse& { return s.reuse; });
  drawGroup(viewer, "Picture", "picture", settings::pictureTable(), settings::State(),
            [](settings::State& s) -> settings::State& { return s; }, {"seconds", "width", "height"});
}

} // namespace viewer
