// The viewer without a window: a state that is edited, and the pictures of it.
#pragma once

#include "CameraPath.h"
#include "Display.h"
#include "ErrorMeter.h"
#include "FrameTimes.h"
#include "History.h"
#include "Navigation.h"
#include "Playback.h"
#include "Quality.h"
#include "SceneLoader.h"
#include "Way.h"

#include <chrono>
#include <functional>
#include <gl/Context.h>
#include <render/RenderFrame.h>

namespace viewer {

/// A line for the person who looks on.
struct Message {
  std::string text;
  bool isError = false;
};

/// What update() did.
enum class Activity {
  Idle,    ///< nothing, and there is nothing to do until something is changed
  Waiting, ///< a scene is being loaded, or a path recorded
  Drew,    ///< another picture is shown, or a part of one
  Measured ///< a part of the error
};

class Viewer {
public:
  /// In the current context, which outlives it. Throws host::Error.
  Viewer(const host::Context& context, tyndall::ProgramStore programs);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Scenes and states. What cannot be read is a message, and all stays as it is.
  void open(const std::filesystem::path& scene);
  void openState(const std::filesystem::path& file);
  void saveState(const std::filesystem::path& file);
  /// What is shown, at full quality, as tyndall-render would: .exr or .png.
  void savePicture(const std::filesystem::path& file);
  const SceneLoader& loader() const { return loader_; }
  const host::Scene* scene() const { return drawer_ ? &drawer_->scene() : nullptr; }
  bool hasVolumes() const { return drawer_ && drawer_->hasVolumes(); } ///< smoke or strands
  double sceneSize() const; ///< the diagonal of its bounds; 1 without a scene
  double duration() const { return duration_; }

  const settings::State& state() const { return history_.state(); }
  const History& history() const { return history_; }
  /// See History. A state that breaks a rule or contradicts itself is not taken, and a message.
  void edit(const std::string& what, const settings::State& state);
  void endEdit() { history_.endEdit(); }
  void undo();
  void redo();

  /// The picture's size.
  void resize(int width, int height);
  LookAt view() const; ///< the camera as one that can be moved
  void setView(const LookAt& view);
  void useSceneCamera(int index);
  void frameAll();
  void setSeconds(double seconds);
  Playback playback;

  /// The state's path: the camera's views are added to it from now on, which makes a new one, or are not any more.
  void record(bool records);
  bool isRecording() const { return isRecording_; }
  double pathSeconds() const { return pathSeconds_; } ///< that were recorded, or played, so far
  /// The camera takes the path from its begin, once, or again and again as the playback says; until it is moved.
  void playPath(bool plays);
  bool isOnPath() const { return pathSeconds_ >= 0 && !isRecording_; }

  /// How the state's two ways are shown, at once: up to where the first is, the second in its place, and what is full
  /// red or blue.
  void setWipe(float share);
  void showSecond(bool shows);
  void setDifferenceScale(float scale);
  const DisplayOptions& shownAs() const { return options_; }
  bool showsSecond() const { return showsSecond_; }

  bool measuresErrors = true;
  Quality quality;

  /// To be called again and again, with seconds of any clock: the one function that draws, in the context that it was
  /// made in, and may take long. Meanwhile it calls whileDrawing.
  Activity update(double now);
  /// Called every few hundredths of a second where update() takes longer, so that a window may live on. It may make
  /// another context current for a while, and call all but what draws: update(), pixelAt(), savePicture(). What has
  /// changed after it ends what is being drawn. Null: nothing is.
  std::function<void()> whileDrawing;
  /// Ends what update() is about, from whileDrawing.
  void abandon() { isAbandoned_ = true; }

  GLuint picture() const { return display_.texture(); }
  /// Of what is shown, at a point of the picture from (0, 0) at the left bottom to (1, 1).
  struct PixelValues {
    int x = 0, y = 0; ///< from the left bottom
    tyndall::Rgb inscatter{}, transmittance{};
    double distance = 0; ///< from the eye; infinite for sky
  };
  PixelValues pixelAt(double x, double y) const;

  bool isDrawing() const { return isInterruptible_; } ///< at full quality, at the moment
  bool isSettled() const;                             ///< at full quality, nothing moves
  bool isMeasured() const { return meter_.isComplete(); }
  const ErrorMeter& meter() const { return meter_; }
  const Way& first() const { return *first_; }
  const Way* second() const { return state().compared ? second_.get() : nullptr; } ///< none: nothing is compared
  const host::RenderTargets& surfaces() const { return *surfaces_; }               ///< of a scene that was drawn
  const FrameTimes& frameTimes() const { return frameTimes_; }
  double sceneMilliseconds() const { return sceneMilliseconds_; } ///< of maps and surfaces, in the last frame
  double exposureStops() const;                                   ///< that is shown

  bool lightsFog() const { return drawer_ && drawer_->lightsFog(state()); }
  /// The scene's banks of fog as a state fills them.
  settings::StateFog fogOf(const settings::State& state) const {
    return drawer_ ? drawer_->fogOf(state) : settings::StateFog();
  }
  tyndall::Ambient sceneAmbient() const { return drawer_ ? drawer_->ambientOf(settings::State()) : tyndall::Ambient(); }
  const tyndall::Medium& sceneMedium() const { return sceneMedium_; } ///< in place of which a state may have another

  /// The last message, once.
  std::optional<Message> takeMessage();
  const std::vector<std::string>& notes() const { return notes_; } ///< of the scene and the frame

private:
  enum class Drawn { Nothing, Moving, Full };

  /// What a picture that may be given up is about.
  class Interruptible {
  public:
    explicit Interruptible(Viewer& viewer);
    ~Interruptible() { viewer_.isInterruptible_ = false; }
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

  private:
    Viewer& viewer_;
  };

  void say(const std::string& text, bool isError = false) { message_ = Message{text, isError}; }
  tyndall::Config configOf();
  void makeWays();
  tyndall::Camera sceneCamera(const std::vector<glm::dmat4>& pose) const;
  render::Picture readPicture() const;
  void requireOwnFile(const std::filesystem::path& file) const;
  static LookAt madeUpView(const render::SceneDrawer& drawer, const settings::State& state, host::Notes& notes);
  void takeScene(SceneLoader::Result result);
  void advance(double passed);
  void followPath(double passed);
  void addToPath(double passed);
  void changed();
  bool isPlaying() const; ///< an animation, or the path
  bool isMoving(double now) const;
  bool goesOn();
  void drawScene(const settings::State& state, bool isCoarse);
  bool drawWholeScene(const settings::State& state);
  bool drawWay(Way& way, const tyndall::Settings& settings);
  void prepareTargets(const settings::State& state);
  void drawMoving();
  void settle();
  void measure();
  bool needsMeasuring() const;
  Activity proceed(double now);
  void show() { isShown_ = false; }
  void drawDisplay();
  void updateExposure();

  const host::Context& context_;
  tyndall::ProgramStore programs_;
  SceneLoader loader_;
  std::optional<settings::State> loadedState_; ///< for the scene that is being loaded
  History history_;
  std::unique_ptr<render::SceneDrawer> drawer_;
  std::unique_ptr<host::RenderTargets> surfaces_;
  int samples_ = 1; ///< of a pixel of the surfaces
  std::unique_ptr<Way> first_, second_;
  tyndall::Tuning tuning_; ///< that the ways were made with
  ErrorMeter meter_;
  Display display_;
  DisplayOptions options_; ///< wipe and scale of differences; the rest is the state's
  bool showsSecond_ = false;
  host::GlFramebuffer probe_; ///< of single pixels
  tyndall::Frame frame_;
  tyndall::Medium sceneMedium_;
  double duration_ = 0;
  double now_ = 0, lastChange_ = -1;
  Drawn drawn_ = Drawn::Nothing;
  bool isDirty_ = false;  ///< changed since it was drawn
  bool isEdited_ = false; ///< more than camera and time: the effect keeps nothing of what it drew
  bool isShown_ = true;   ///< as it was drawn
  bool isRecording_ = false;
  std::vector<settings::PathPoint> recorded_; ///< so far
  double pathSeconds_ = -1; ///< from the begin of the path that is taken or recorded; negative: none is
  bool isInterruptible_ = false, isAbandoned_ = false;
  std::chrono::steady_clock::time_point lastPause_; ///< the end of the last call of whileDrawing
  double pauses_ = 0;                               ///< milliseconds in them, of this picture
  bool hasFailed_ = false;                          ///< until something is changed
  std::optional<float> exposure_;
  FrameTimes frameTimes_;
  double sceneMilliseconds_ = 0;
  std::optional<Message> message_;
  std::vector<std::string> notes_;
};

} // namespace viewer
