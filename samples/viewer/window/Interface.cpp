// What the window shows, and what mouse and keys do in it.
#include "Picture.h"
#include "Widgets.h"
#include "Window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace viewer {

namespace {

constexpr double kRadiansPerPixel = 0.006;

Area areaOf(float panelWidth) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  return {panelWidth, 0, std::max(display.x - panelWidth, 1.0F), display.y};
}

} // namespace

void Window::drawPicture() {
  const Area area = areaOf(panelWidth_);
  if (viewer_->picture() != 0)
    ImGui::GetBackgroundDrawList()->AddImage(imageOf(viewer_->picture()), ImVec2(area.x, area.y),
                                             ImVec2(area.x + area.width, area.y + area.height), ImVec2(0, 1),
                                             ImVec2(1, 0));
  const bool isOnWipe = dragWipe(*session_, area);
  const bool isOnLight = dragLights(*session_, area, !isOnWipe);
  drawMagnifier(*session_, area);
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left)) isHandled_ = false;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) isHandled_ = isOnWipe || isOnLight;
  if (io.WantCaptureMouse || isHandled_ || !viewer_->scene() || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
  const double x = io.MouseDelta.x, y = io.MouseDelta.y;
  const LookAt view = viewer_->view();
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
    viewer_->setView(orbited(view, x * kRadiansPerPixel, -y * kRadiansPerPixel));
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
    viewer_->setView(turned(view, x * kRadiansPerPixel, -y * kRadiansPerPixel));
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle))
    viewer_->setView(panned(view, -x / area.height, y / area.height));
}

void Window::drawPanel() {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(panelWidth_, display.y));
  constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("panel", nullptr, kFixed) && ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) {
    const std::pair<const char*, void (*)(Session&)> tabs[] = {
        {"Scene", drawScenePanel},       {"Light", drawLightPanel}, {"Medium", drawMediumPanel},
        {"Settings", drawSettingsPanel}, {"Cost", drawCostPanel},   {"Compare", drawComparePanel},
        {"Save", drawSavePanel}};
    for (const auto& [name, draw] : tabs)
      if (ImGui::BeginTabItem(name)) {
        ImGui::BeginChild("content");
        draw(*session_);
        ImGui::EndChild();
        ImGui::EndTabItem();
      }
    ImGui::EndTabBar();
  }
  ImGui::End();
}

void Window::drawStatus() {
  std::string text = session_->message.text;
  if (viewer_->loader().isLoading())
    text = fmt::format("loading {}: {}, {:.0f} %", viewer_->loader().file().filename().string(),
                       viewer_->loader().stage(), 100 * viewer_->loader().share());
  else if (!viewer_->scene() && text.empty())
    text = "choose a scene, or drop a glTF file here; F1: help";
  if (viewer_->scene() && viewer_->first().width() > 0) {
    text += text.empty() ? "" : "   |   ";
    text += viewer_->isDrawing() ? std::string("drawing at full quality ...")
                                 : fmt::format("{} {:.0f} ms", viewer_->isSettled() ? "full quality" : "adapted",
                                               viewer_->sceneMilliseconds() + viewer_->first().milliseconds());
    if (viewer_->isMeasured())
      text += fmt::format("   |   rRMSE {:.2g} %", 100 * viewer_->meter().errors()[0].rRmse);
    else if (viewer_->meter().isRunning())
      text += fmt::format("   |   measuring the error: {:.0f} %", 100 * viewer_->meter().share());
  }
  if (text.empty()) return;
  const Area area = areaOf(panelWidth_);
  const float padding = 6;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, area.width - 2 * padding);
  const float top = area.height - size.y - 2 * padding;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled(ImVec2(area.x, top), ImVec2(area.x + area.width, area.height), IM_COL32(0, 0, 0, 170));
  const ImU32 colour = session_->message.isError ? IM_COL32(255, 140, 120, 255) : IM_COL32(230, 230, 230, 255);
  list.AddText(nullptr, 0, ImVec2(area.x + padding, top + padding), colour, text.c_str(), nullptr,
               area.width - 2 * padding);
}

void Window::scroll(double steps) {
  if (!viewer_->scene() || ImGui::GetIO().WantCaptureMouse) return;
  constexpr double kStep = 1.12;
  if (glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS)
    session_->flySpeed = std::clamp(session_->flySpeed * std::pow(kStep, steps), 0.01, 100.0);
  else
    viewer_->setView(zoomed(viewer_->view(), std::pow(kStep, -steps)));
}

void Window::control(int key) {
  if (key == GLFW_KEY_Z) viewer_->undo();
  if (key == GLFW_KEY_Y) viewer_->redo();
  if (key == GLFW_KEY_O) {
    session_->asked = Session::Asked::Scene;
    session_->dialog.open("Open a scene", viewer_->state().scene.parent_path(), {".glb", ".gltf"});
  }
  if (key != GLFW_KEY_S || !viewer_->scene()) return;
  session_->asked = Session::Asked::SaveState;
  session_->dialog.open("Save the state", std::filesystem::current_path(), {".json"},
                        viewer_->state().scene.stem().string() + ".json");
}

void Window::key(int key, int mods) {
  if (key == GLFW_KEY_F1) session_->hasHelp = !session_->hasHelp;
  if (key == GLFW_KEY_ESCAPE) {
    session_->hasHelp = false;
    session_->dialog.cancel();
  }
  if (key == GLFW_KEY_Q && (mods & GLFW_MOD_CONTROL) != 0) glfwSetWindowShouldClose(window_, GLFW_TRUE);
  if (ImGui::GetIO().WantTextInput || session_->dialog.isOpen()) return;
  if ((mods & GLFW_MOD_CONTROL) != 0) return control(key);
  if (key == GLFW_KEY_TAB) showsPanel_ = !showsPanel_;
  if (key == GLFW_KEY_F) viewer_->frameAll();
  if (key == GLFW_KEY_P) viewer_->playback.isPlaying = !viewer_->playback.isPlaying && viewer_->duration() > 0;
  if (key == GLFW_KEY_B) session_->blinks = viewer_->second() && !session_->blinks;
  if (key == GLFW_KEY_H) session_->hasHandles = !session_->hasHandles;
  if (key == GLFW_KEY_M) session_->hasMagnifier = !session_->hasMagnifier;
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) viewer_->useSceneCamera(key - GLFW_KEY_1);
  if ((key == GLFW_KEY_LEFT || key == GLFW_KEY_RIGHT) && viewer_->duration() > 0)
    viewer_->setSeconds(
        Playback::stepped(viewer_->state().seconds, key == GLFW_KEY_LEFT ? -1 : 1, viewer_->duration()));
}

void Window::navigate() {
  const bool mayFly = viewer_->scene() && !ImGui::GetIO().WantTextInput && !session_->dialog.isOpen() &&
                      glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) != GLFW_PRESS &&
                      glfwGetKey(window_, GLFW_KEY_RIGHT_CONTROL) != GLFW_PRESS;
  const auto axis = [&](int plus, int minus) {
    return (glfwGetKey(window_, plus) == GLFW_PRESS ? 1.0 : 0.0) -
           (glfwGetKey(window_, minus) == GLFW_PRESS ? 1.0 : 0.0);
  };
  const glm::dvec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S));
  const double now = glfwGetTime();
  const bool wasFlying = isFlying_;
  isFlying_ = mayFly && direction != glm::dvec3(0);
  if (isFlying_ && wasFlying) {
    constexpr double kLongest = 0.25; // of a frame that took long
    const double passed = std::min(now - lastFlight_, kLongest);
    viewer_->setView(flown(viewer_->view(), direction * (passed * session_->flySpeed * viewer_->sceneSize() / 10)));
  }
  lastFlight_ = now;
}

} // namespace viewer
