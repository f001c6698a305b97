// All that a person sets to see one picture: what tyndall-render is told, and what the viewer shows, saves and loads.
#pragma once

#include <filesystem>
#include <gl/MapForm.h>
#include <glm/glm.hpp>
#include <optional>
#include <scene/ImageFile.h>
#include <scene/Scene.h>
#include <tyndall/tyndall.h>
#include <vector>

namespace settings {

/// A perspective view with y up.
struct LookAt {
  glm::dvec3 eye{0, 0, 1};
  glm::dvec3 target{0};
  double fovDegrees = 50; ///< vertical
};

/// Where a camera was at a time of its path.
struct PathPoint {
  double seconds = 0; ///< from its begin
  LookAt view;
};

/// A second way of drawing the same, beside the state's.
struct Compared {
  tyndall::Profile profile = tyndall::Profile::Performance; ///< that the settings began as
  tyndall::Settings settings = tyndall::settingsOf(tyndall::Profile::Performance);
};

/// A light in place of the scene's.
struct StateLight {
  bool on = true;
  /// Which of the scene's lights, from 0, it takes position and direction of, also while that moves; -1: its own.
  int follows = -1;
  tyndall::Light light; ///< without shadow views and textures, which are drawn
};

/// Fog in place of the scene's.
struct StateFog {
  host::FogScattering scattering;
  /// In the order of the scene's, which have their places, their shapes and the number of their billows; those that are
  /// more than these are the scene's in all.
  std::vector<host::FogBank> banks;
};

struct State {
  std::filesystem::path scene;
  std::optional<int> camera;                     ///< of the scene's; none: the first, or one that is made up
  std::optional<LookAt> lookAt;                  ///< in place of the scene's cameras
  std::optional<std::vector<StateLight>> lights; ///< none: the scene's
  std::optional<tyndall::Medium> medium;         ///< none: the scene's
  std::optional<tyndall::Ambient> ambient;       ///< none: the scene's
  std::optional<StateFog> fog;                   ///< none: the scene's
  double seconds = 0;                            ///< of the animation
  int width = 1280;
  int height = 720;
  int supersample = 1;                 ///< pixels rendered for one of the picture, along each side
  int msaa = 1;                        ///< samples of a pixel
  int halton = 0;                      ///< places in a pixel that frames are rendered at in turn; 0: its centre
  std::optional<double> exposureStops; ///< none: by the picture's brightness
  host::Tone tone = host::Tone::Film;
  tyndall::Profile profile = tyndall::Profile::High; ///< that the settings began as
  tyndall::Settings settings = tyndall::settingsOf(tyndall::Profile::High);
  tyndall::Reuse reuse;
  tyndall::Tuning tuning;
  int shadowSize = 4096;
  int cascades = 1;
  double cascadeFade = 0.1;   ///< of the scene's lights
  bool steadyShadows = false; ///< whether texels of directional lights' maps stay in place while the camera moves
  host::MapForm mapForm;      ///< in which the effect is handed shadow and glass maps
  bool avsm = true;           ///< whether smoke and strands cast shadows
  bool eyeCurves = true;      ///< and smoke dims the shafts behind it
  bool litSmoke = true;       ///< whether the effect lights smoke of which the scene says what it scatters
  int avsmSize = 256;         ///< texels per side
  int avsmNodes = 8;
  double smokeDensity = 1;    ///< times what the scene says
  double strandWidth = 1;     ///< the same
  double strandOpacity = 1;   ///< the same
  bool reversedDepth = false; ///< of camera and shadow maps, with clip depth from 0 to 1
  // What the viewer keeps with them, and tyndall-render leaves alone.
  std::optional<Compared> compared;
  std::vector<PathPoint> path; ///< that a camera took, in the order of time
};

constexpr std::size_t kMostPathPoints = 4096;

/// Pixels per side that are rendered.
inline int renderedWidth(const State& state) { return state.width * state.supersample; }
inline int renderedHeight(const State& state) { return state.height * state.supersample; }

/// Why the picture cannot be drawn though each field keeps its rule: "FIELD: why"; empty if it can.
std::string contradictionIn(const State& state);
std::string contradictionIn(const tyndall::Medium& medium);

/// The same of fields that break their rules, too.
std::string problemIn(const State& state);

/// The lights where they are: those that follow one of the scene's at its place.
std::vector<StateLight> placed(std::vector<StateLight> lights, const std::vector<tyndall::Light>& scene);

/// The lights of a frame: those of the state, of which some follow the scene's.
std::vector<tyndall::Light> lightsOf(const std::vector<StateLight>& lights, const std::vector<tyndall::Light>& scene);

/// The scene's lights as a state has them, each following its own.
std::vector<StateLight> following(const std::vector<tyndall::Light>& scene);

} // namespace settings
