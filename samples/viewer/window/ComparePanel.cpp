// A second way beside the first, and a closer look.
#include "Panels.h"
#include "Widgets.h"

namespace viewer {

namespace {

void edit(Viewer& viewer, const std::string& what, const settings::Compared& compared) {
  settings::State state = viewer.state();
  state.compared = compared;
  viewer.edit("compared." + what, state);
}

void chooseProfile(Viewer& viewer, tyndall::Profile now) {
  for (const settings::Choice& profile : settings::kProfiles) {
    const auto value = static_cast<tyndall::Profile>(profile.value);
    if (profile.value > 0) ImGui::SameLine();
    if (ImGui::RadioButton(profile.enumerator, now == value))
      edit(viewer, "profile", {value, tyndall::settingsOf(value)});
  }
}

void drawSecond(Session& session, const settings::Compared& now) {
  Viewer& viewer = session.viewer;
  ImGui::SetNextItemWidth(-1);
  float percent = 100 * viewer.shownAs().wipe;
  if (ImGui::SliderFloat("##wipe", &percent, 0, 100, "wipe: A to %.0f %%")) viewer.setWipe(percent / 100);
  ImGui::Checkbox("blink (B)", &session.blinks);
  ImGui::SameLine();
  if (ImGui::SmallButton("B takes A's")) edit(viewer, "all", {viewer.state().profile, viewer.state().settings});
  ImGui::SameLine();
  if (ImGui::SmallButton("A takes B's")) {
    settings::State state = viewer.state();
    state.settings = now.settings;
    state.profile = now.profile;
    viewer.edit("settings of B", state);
  }
  if (!viewer.second()) return;
  ImGui::Text("effect: A %.1f ms, B %.1f ms", viewer.first().milliseconds(), viewer.second()->milliseconds());
  const std::vector<Errors>& errors = viewer.meter().errors();
  if (errors.size() > 1)
    ImGui::Text("rRMSE: A %.3g %%, B %.3g %%\np99:   A %.3g %%, B %.3g %%", 100 * errors[0].rRmse,
                100 * errors[1].rRmse, 100 * errors[0].p99, 100 * errors[1].p99);
  ImGui::Separator();
  ImGui::TextUnformatted("Settings of B");
  chooseProfile(viewer, now.profile);
  settings::Compared edited = now;
  std::string field;
  if (editRows(settings::settingsTable(), edited.settings, tyndall::settingsOf(edited.profile), field, {"debugView"}))
    edit(viewer, field, edited);
}

} // namespace

void drawComparePanel(Session& session) {
  Viewer& viewer = session.viewer;
  bool isCompared = viewer.state().compared.has_value();
  if (ImGui::Checkbox("compare A, the settings, with B", &isCompared)) {
    settings::State compared = viewer.state();
    compared.compared = isCompared ? std::optional(settings::Compared()) : std::nullopt;
    viewer.edit("compared", compared);
    if (isCompared) viewer.setWipe(0.5F);
  }
  ImGui::Checkbox("magnifier (M)", &session.hasMagnifier);
  settings::State state = viewer.state();
  const settings::Setting<tyndall::Settings>& row = settings::settingsTable()["debugView"];
  settings::Value value = row.get(state.settings);
  if (editValue(row, value, row.get(tyndall::Settings()))) {
    row.set(state.settings, value);
    viewer.edit("settings.debugView", state);
  }
  if (state.settings.debugView == tyndall::DebugView::Difference) {
    float percent = 100 * viewer.shownAs().differenceScale;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##scale", &percent, 0.1F, 100, "full colour at %.1f %% of the mean",
                           ImGuiSliderFlags_Logarithmic))
      viewer.setDifferenceScale(std::max(percent, 0.1F) / 100);
  }
  if (const std::optional<settings::Compared> now = viewer.state().compared) drawSecond(session, *now);
}

} // namespace viewer
