// Pictures, states and texts to take home; help.
#include "Panels.h"
#include "Widgets.h"

#include <settings/CodeText.h>
#include <settings/CommandText.h>

namespace viewer {

namespace {

void copy(Session& session, const char* what, const std::string& text) {
  ImGui::SetClipboardText(text.c_str());
  session.message = {std::string("copied as ") + what, false};
}

struct Key {
  const char* keys;
  const char* what;
};

constexpr Key kKeys[] = {
    {"left drag", "orbit around the target"},
    {"right drag", "look around"},
    {"middle drag", "move sideways"},
    {"wheel", "nearer, farther; with the right button the speed of flight"},
    {"W A S D Q E", "fly; Q down, E up"},
    {"F, 1 to 9", "frame all, the scene's cameras"},
    {"P, left, right", "play or pause, a frame back or on"},
    {"circles", "lights: drag them; squares: the chosen one's direction, cone and range; H hides them"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo"},
    {"Ctrl+O, Ctrl+S", "open a scene, save the state"},
    {"Ctrl+Q", "leave"},
    {"B, M", "blink between A and B, magnifier"},
    {"Tab", "hide or show the panel"},
    {"Ctrl+click", "on a slider: type the number"},
    {"right click", "on a setting: its default"},
    {"F1, Escape", "this help; close it, or a dialog"},
};

} // namespace

void drawSavePanel(Session& session) {
  Viewer& viewer = session.viewer;
  const settings::State& state = viewer.state();
  const std::string stem = state.scene.stem().string();
  const auto ask = [&](const char* label, Session::Asked asked, const char* title, std::vector<std::string> endings,
                       const std::string& name) {
    if (!ImGui::Button(label, ImVec2(-1, 0))) return;
    session.asked = asked;
    session.dialog.open(title, std::filesystem::current_path(), std::move(endings), name);
  };
  using Asked = Session::Asked;
  ImGui::BeginDisabled(!viewer.scene());
  ask("save picture, PNG or EXR ...", Asked::SavePicture, "Save the picture", {".png", ".exr"}, stem + ".png");
  ask("save state ... (Ctrl+S)", Asked::SaveState, "Save the state", {".json"}, stem + ".json");
  ImGui::EndDisabled();
  ask("load state ...", Asked::LoadState, "Load a state", {".json"}, "");
  ImGui::BeginDisabled(!viewer.scene() || viewer.first().width() == 0);
  if (ImGui::Button("copy as command line", ImVec2(-1, 0))) copy(session, "a command line", settings::commandOf(state));
  if (ImGui::Button("copy as C++", ImVec2(-1, 0)))
    copy(session, "C++", settings::codeOf(viewer.first().frame(), state.tuning));
  ImGui::EndDisabled();
  if (ImGui::Button("help (F1)", ImVec2(-1, 0))) session.hasHelp = true;
  if (viewer.scene()) {
    ImGui::Separator();
    ImGui::TextWrapped("%s", settings::commandOf(state).c_str());
  }
}

void drawHelp(Session& session) {
  if (!session.hasHelp) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5F * display.x, 0.5F * display.y), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowSize(ImVec2(std::min(560.0F, 0.95F * display.x), std::min(430.0F, 0.95F * display.y)));
  if (ImGui::Begin("Help", &session.hasHelp, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    ImGui::TextWrapped(
        "Tyndall adds the light that a medium scatters, with its shadows, to a picture. Every setting has the "
        "name that it has in tyndall.h; names in yellow are not at their default.");
    ImGui::Separator();
    for (const Key& key : kKeys) {
      ImGui::TextUnformatted(key.keys);
      ImGui::SameLine(0.3F * ImGui::GetWindowWidth());
      ImGui::TextWrapped("%s", key.what);
    }
  }
  ImGui::End();
}

} // namespace viewer
