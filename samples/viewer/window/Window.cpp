#include "Window.h"
#include "Layout.h"
#include "Picture.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <cmath>
#include <cstdio>
#include <gl/Gl.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Places.h>
#include <scene/ProgramFiles.h>
#include <utility>

namespace viewer {

namespace {

constexpr double kMeasuredPause = 0.25; ///< seconds between two looks at how far the error is

void* load(const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

std::string lastError() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description ? description : "no reason given";
}

struct Windows {
  GLFWwindow *seen = nullptr, *workshop = nullptr;
};

Windows makeWindows(const Layout& layout, bool isDebug) {
  if (!glfwInit()) throw host::Error("no window: GLFW cannot start: " + lastError());
  for (const auto& [major, minor] : {std::pair{4, 5}, std::pair{4, 3}, std::pair{4, 1}, std::pair{3, 3}}) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, isDebug ? GLFW_TRUE : GLFW_FALSE);
    GLFWwindow* const seen = glfwCreateWindow(layout.width, layout.height, "Tyndall viewer", nullptr, nullptr);
    if (!seen) continue;
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    if (GLFWwindow* const workshop = glfwCreateWindow(1, 1, "Tyndall viewer: pictures", nullptr, seen))
      return {seen, workshop};
    glfwDestroyWindow(seen);
  }
  const std::string reason = lastError();
  glfwTerminate();
  throw host::Error("no window with OpenGL 3.3: " + reason);
}

std::unique_ptr<host::Context> contextOf(GLFWwindow* window, bool isDebug) {
  return host::Context::adopt(load, [window](bool isCurrent) { glfwMakeContextCurrent(isCurrent ? window : nullptr); },
                              {isDebug});
}

tyndall::ProgramStore keptPrograms() {
  const auto folder = host::programFolder();
  return folder ? host::programFiles(*folder) : tyndall::ProgramStore();
}

Window& windowOf(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

} // namespace

Window::Window(bool reports) : reports_(reports) {
  const Layout layout = loadLayout();
  const Windows windows = makeWindows(layout, reports);
  window_ = windows.seen;
  workshop_ = windows.workshop;
  showsPanel_ = layout.showsPanel;
  glfwSetWindowUserPointer(window_, this);
  screen_ = contextOf(window_, reports);
  glfwSwapInterval(1);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr; // the layout is ours
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().ConfigInputTrickleEventQueue = false; // each press has a frame of its own: setCallbacks()
#endif
  float scaleX = 1, scaleY = 1;
  glfwGetWindowContentScale(window_, &scaleX, &scaleY);
  setScale(std::max(scaleX, scaleY));
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  setCallbacks();
  drawing_ = contextOf(workshop_, reports);
  viewer_ = std::make_unique<Viewer>(*drawing_, keptPrograms());
  viewer_->whileDrawing = [this] { turn(); };
  session_ = std::make_unique<Session>(*viewer_);
  session_->thumbnails.load(host::placeOf("scenes", TYNDALL_SCENES_DIR), TYNDALL_GALLERY_DIR);
  host::gl().Finish();
}

Window::~Window() {
  keepLayout();
  drawing_->makeCurrent();
  session_.reset();
  viewer_.reset();
  drawing_.reset();
  screen_->makeCurrent();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  screen_.reset();
  glfwDestroyWindow(workshop_);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::setScale(float scale) {
  scale_ = scale;
  ImFontConfig font;
  font.SizePixels = std::floor(13 * scale);
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(scale);
}

// Before version 1.87 Dear ImGui asks once a frame where the mouse is by then and what is pressed. So it is told where
// the events are; what is under a press is drawn before it knows of the press, and what comes of it before the mouse
// goes on, or the key is let go.
void Window::setCallbacks() {
  static GLFWkeyfun guiKey = nullptr;
  static GLFWmousebuttonfun guiButton = nullptr;
  guiKey = glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    // Undo of a text that was set anew since: Dear ImGui would write beside it.
    const bool isTextUndo = (mods & GLFW_MOD_CONTROL) != 0 && (key == GLFW_KEY_Z || key == GLFW_KEY_Y);
    if (!isTextUndo || action == GLFW_RELEASE) guiKey(w, key, scancode, action, mods);
    if (action != GLFW_RELEASE) windowOf(w).key(key, mods);
    if (action == GLFW_PRESS) windowOf(w).drawInterface();
    windowOf(w).wake();
  });
  guiButton = glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
    if (action == GLFW_PRESS) windowOf(w).drawInterface(button);
    guiButton(w, button, action, mods);
    windowOf(w).drawInterface();
    windowOf(w).wake();
  });
  static GLFWscrollfun guiScroll = nullptr;
  guiScroll = glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double steps) {
    guiScroll(w, x, steps);
    windowOf(w).scroll(steps);
    windowOf(w).wake();
  });
  static GLFWwindowfocusfun guiFocus = nullptr;
  guiFocus = glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int isFocused) {
    guiFocus(w, isFocused);
    windowOf(w).wake();
  });
  static GLFWcursorposfun guiCursor = nullptr;
  guiCursor = glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    if (guiCursor) guiCursor(w, x, y);
    windowOf(w).cursor_ = glm::dvec2(x, y);
    windowOf(w).wake();
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
    if (count > 0) windowOf(w).open(files[0]);
    windowOf(w).wake();
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { windowOf(w).wake(); });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { windowOf(w).wake(); });
}

void Window::open(const std::filesystem::path& file) {
  if (file.extension() == ".json")
    viewer_->openState(file);
  else
    viewer_->open(file);
}

bool Window::run(const std::filesystem::path& file) {
  layOut();
  if (!file.empty()) open(file);
  while (!glfwWindowShouldClose(window_)) {
    navigate();
    blink();
    if (const auto picture = std::exchange(session_->pictureToSave, std::nullopt)) viewer_->savePicture(*picture);
    const Activity activity = viewer_->update(glfwGetTime());
    takeMessage();
    reportErrors();
    reportRest(activity == Activity::Idle);
    const bool isDue = activity == Activity::Drew || glfwGetTime() - lastDrawn_ > kMeasuredPause;
    if (framesToDraw_ > 0 || (activity != Activity::Idle && isDue)) drawInterface();
    waitForEvents(activity);
  }
  return !hasErrors_;
}

// What has come to an end is shown, and told to who watches from outside.
void Window::reportRest(bool rests) {
  if (rests != rests_) wake();
  if (reports_ && rests != rests_) std::fputs(rests ? "at rest\n" : "busy\n", stderr);
  rests_ = rests;
}

void Window::reportErrors() {
  if (!reports_) return;
  for (host::Context* context : {screen_.get(), drawing_.get()})
    for (const std::string& error : context->takeErrors()) {
      std::fprintf(stderr, "GL: %s\n", error.c_str());
      hasErrors_ = true;
    }
  drawing_->makeCurrent();
}

// In the middle of a picture that takes long.
void Window::turn() {
  glfwPollEvents();
  if (glfwWindowShouldClose(window_)) return viewer_->abandon();
  navigate();
  blink();
  takeMessage();
  drawInterface();
}

void Window::takeMessage() {
  const std::optional<Message> message = viewer_->takeMessage();
  if (!message) return;
  session_->message = *message;
  if (reports_ && message->isError) std::fprintf(stderr, "said: %s\n", message->text.c_str());
  wake();
}

// Nothing is done at rest until something happens.
void Window::waitForEvents(Activity activity) {
  constexpr double kPause = 0.02;
  const bool isBusy = activity == Activity::Drew || activity == Activity::Measured || framesToDraw_ > 0 || isFlying_;
  if (isBusy)
    glfwPollEvents();
  else if (activity == Activity::Waiting || session_->blinks)
    glfwWaitEventsTimeout(kPause);
  else
    glfwWaitEvents();
}

void Window::layOut() {
  int width = 0, height = 0, pixelWidth = 0, pixelHeight = 0;
  glfwGetWindowSize(window_, &width, &height);
  glfwGetFramebufferSize(window_, &pixelWidth, &pixelHeight);
  if (width < 1 || height < 1) return; // minimised
  panelWidth_ = showsPanel_ ? std::min(kPanelWidth * scale_, 0.6F * static_cast<float>(width)) : 0;
  const double pixels = static_cast<double>(pixelWidth) / width;
  viewer_->resize(pixelWidth - static_cast<int>(panelWidth_ * pixels), pixelHeight);
}

void Window::drawInterface(int unknownPress) {
  layOut();
  lookCloser();
  screen_->makeCurrent();
  drawFrame(unknownPress);
  drawing_->makeCurrent();
}

// At the pixel under the mouse; as long as one is being drawn, at what was seen before.
void Window::lookCloser() {
  if (!session_->hasMagnifier || !viewer_->scene() || viewer_->isDrawing()) return;
  double x = 0, y = 0;
  int width = 0, height = 0;
  glfwGetCursorPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  const double pictureWidth = static_cast<double>(width) - panelWidth_;
  if (pictureWidth <= 0 || height <= 0) return;
  const double across = (x - panelWidth_) / pictureWidth, up = 1 - y / height;
  if (across >= 0 && across < 1 && up > 0 && up <= 1) session_->magnified = viewer_->pixelAt(across, up);
}

void Window::drawFrame(int unknownPress) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  if (IMGUI_VERSION_NUM < 18700 && cursor_)
    ImGui::GetIO().MousePos = ImVec2(static_cast<float>(cursor_->x), static_cast<float>(cursor_->y));
  if (unknownPress >= 0 && unknownPress < ImGuiMouseButton_COUNT) ImGui::GetIO().MouseDown[unknownPress] = false;
  ImGui::NewFrame();
  drawPicture();
  if (showsPanel_) drawPanel();
  drawStatus();
  drawHelp(*session_);
  if (const auto file = session_->dialog.draw()) takeFile(*file);
  if (!ImGui::IsAnyItemActive() && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) viewer_->endEdit();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  const GladGLContext& gl = host::gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.Viewport(0, 0, width, height);
  gl.Disable(GL_SCISSOR_TEST);
  gl.ClearColor(0, 0, 0, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
  if (framesToDraw_ > 0) --framesToDraw_;
  lastDrawn_ = glfwGetTime();
}

void Window::takeFile(const std::filesystem::path& file) {
  switch (session_->asked) {
  case Session::Asked::Scene:
    return viewer_->open(file);
  case Session::Asked::LoadState:
    return viewer_->openState(file);
  case Session::Asked::SaveState:
    return viewer_->saveState(file);
  case Session::Asked::SavePicture:
    session_->pictureToSave = file;
    return;
  }
}

void Window::blink() {
  constexpr double kPeriod = 0.5;
  const bool isSecond = session_->blinks && std::fmod(glfwGetTime(), 2 * kPeriod) > kPeriod;
  if (!viewer_->second()) session_->blinks = false;
  if (isSecond == viewer_->showsSecond()) return;
  viewer_->showSecond(isSecond && viewer_->second());
  wake();
}

void Window::keepLayout() const {
  Layout layout;
  glfwGetWindowSize(window_, &layout.width, &layout.height);
  layout.showsPanel = showsPanel_;
  saveLayout(layout);
}

} // namespace viewer
