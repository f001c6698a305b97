// Scenes, cameras, animation.
#include "Panels.h"
#include "Widgets.h"

#include <algorithm>
#include <cmath>
#include <scene/FileIo.h>
#include <scene/View.h>

namespace viewer {

namespace {

void drawSamples(Session& session) {
  const float size = 96, step = size + ImGui::GetStyle().ItemSpacing.x;
  const int columns = std::max(1, static_cast<int>(ImGui::GetContentRegionAvail().x / step));
  int column = 0;
  for (const Thumbnails::Sample& sample : session.thumbnails.samples()) {
    if (column++ % columns != 0) ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::PushID(sample.name.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool isChosen = ImGui::Button("##open", ImVec2(size, size * 9 / 16));
    if (sample.picture)
      ImGui::GetWindowDrawList()->AddImage(imageOf(sample.picture.name()), corner,
                                           ImVec2(corner.x + size, corner.y + size * 9 / 16));
    ImGui::TextUnformatted(sample.name.c_str());
    ImGui::PopID();
    ImGui::EndGroup();
    if (isChosen) session.viewer.open(sample.file);
  }
}

void drawPath(Viewer& viewer) {
  const std::vector<settings::PathPoint>& path = viewer.state().path;
  ImGui::BeginDisabled(!viewer.scene());
  if (ImGui::SmallButton(viewer.isRecording() ? "end recording" : "record a path"))
    viewer.record(!viewer.isRecording());
  tooltip("the camera's moves, to be played again; a saved state has them");
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool isPlayed = viewer.isOnPath();
  ImGui::BeginDisabled(path.empty() || viewer.isRecording());
  if (ImGui::SmallButton(isPlayed ? "leave the path" : "play the path")) viewer.playPath(!isPlayed);
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (viewer.isRecording())
    ImGui::TextColored(ImVec4(1, 0.5F, 0.4F, 1), "%.1f s", viewer.pathSeconds());
  else if (!path.empty())
    ImGui::TextDisabled("%.1f of %.1f s", isPlayed ? viewer.pathSeconds() : 0.0, path.back().seconds);
  else
    ImGui::NewLine();
}

void drawCameras(Session& session) {
  Viewer& viewer = session.viewer;
  const std::vector<int> cameras = host::cameraNodes(viewer.scene() ? *viewer.scene() : host::Scene());
  ImGui::Separator();
  ImGui::TextUnformatted("Camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string name = viewer.scene()->nodes[static_cast<std::size_t>(cameras[i])].name;
    const std::string label = std::to_string(i) + (name.empty() ? "" : " " + host::printable(name));
    if (ImGui::SmallButton(label.c_str())) viewer.useSceneCamera(static_cast<int>(i));
    ImGui::SameLine();
  }
  if (ImGui::SmallButton("frame all (F)")) viewer.frameAll();
  settings::LookAt view = viewer.view();
  std::string edited;
  if (viewer.scene() && editRows(settings::lookAtTable(), view, settings::LookAt(), edited)) viewer.setView(view);
  drawPath(viewer);
}

void drawAnimation(Session& session) {
  Viewer& viewer = session.viewer;
  const double duration = viewer.duration();
  ImGui::Separator();
  ImGui::TextUnformatted("Animation");
  if (duration <= 0) return ImGui::TextDisabled("nothing moves in this scene");
  if (ImGui::Button(viewer.playback.isPlaying ? "pause (P)" : "play (P)"))
    viewer.playback.isPlaying = !viewer.playback.isPlaying;
  for (const auto& [name, frames] : {std::pair{"|<", 0}, std::pair{"<", -1}, std::pair{">", 1}}) {
    ImGui::SameLine();
    if (ImGui::Button(name))
      viewer.setSeconds(frames == 0 ? 0 : Playback::stepped(viewer.state().seconds, frames, duration));
  }
  ImGui::SameLine();
  ImGui::Checkbox("loop", &viewer.playback.loops);
  double seconds = viewer.state().seconds;
  const double low = 0, high = std::isfinite(duration) ? duration : std::max(60.0, seconds);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderScalar("##seconds", ImGuiDataType_Double, &seconds, &low, &high, "%.2f s"))
    viewer.setSeconds(seconds);
  const double slow = 0.1, fast = 10;
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderScalar("##speed", ImGuiDataType_Double, &viewer.playback.speed, &slow, &fast, "speed %.2f",
                      ImGuiSliderFlags_Logarithmic);
}

} // namespace

void drawScenePanel(Session& session) {
  if (ImGui::Button("open scene ... (Ctrl+O)")) {
    session.asked = Session::Asked::Scene;
    session.dialog.open("Open a scene", session.viewer.state().scene.parent_path(), {".glb", ".gltf"});
  }
  ImGui::SameLine();
  ImGui::TextDisabled("or drop one here");
  drawSamples(session);
  drawCameras(session);
  drawAnimation(session);
}

} // namespace viewer
