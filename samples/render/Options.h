// The command line of tyndall-render.
#pragma once

#include "CommandLine.h"

#include <filesystem>
#include <gl/Context.h>
#include <gl/ShadowLayout.h>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace render {

struct LookAt {
  glm::dvec3 eye{0};
  glm::dvec3 target{0};
  double fovDegrees = 50; ///< vertical
};

struct Sun {
  glm::dvec3 direction{0};         ///< where the light travels to
  std::optional<glm::vec3> colour; ///< irradiance; the host's sun colour if not given
};

struct FrameRange {
  int first = 0;
  int last = 0;
  int count() const { return last - first + 1; }
};

struct Options {
  std::filesystem::path scene;
  std::optional<int> camera;
  std::optional<LookAt> lookAt;
  std::optional<Sun> sun;
  int width = 1280;
  int height = 720;
  int supersample = 1; ///< pixels rendered for one of the picture, along each side
  int msaa = 1;        ///< samples of a pixel
  int halton = 0;      ///< places in a pixel that frames are rendered at in turn; 0: its centre
  std::string profile = "high";
  std::string technique = "epipolar";
  std::optional<int> slices;  ///< none: by the profile
  std::optional<int> samples; ///< none: by the profile
  std::optional<int> rowStep; ///< none: by the profile
  bool minMaxTree = true;
  std::optional<float> breakThreshold, bendThreshold, leastWeight, averageThreshold,
      spreadThreshold; ///< none: by the profile
  std::optional<int> lowRankTerms, sampleBudget;
  tyndall::DebugView view = tyndall::DebugView::Composite;
  tyndall::ShadowFilter shadowFilter = tyndall::ShadowFilter::Nearest;
  std::optional<std::filesystem::path> medium;
  int shadowSize = 4096;
  int cascades = 1;
  double cascadeFade = 0.1;
  host::MapForm mapForm; ///< in which the effect is handed shadow and glass maps
  int avsmSize = 256;    ///< texels per side
  int avsmNodes = 8;
  bool avsm = true;                 ///< whether smoke and strands cast shadows
  bool reversedDepth = false;       ///< of camera and shadow maps, with clip depth from 0 to 1
  std::optional<FrameRange> frames; ///< none: frame 0, and one object in the statistics instead of a list
  std::optional<Share> share;       ///< none: all of the frames
  bool resume = false;              ///< whether frames whose files are whole stay as they are
  bool missing = false;             ///< whether to draw nothing, and name the frames that are not
  bool debug = true;                ///< whether the driver checks and tells, which takes time of the processor
  bool checkInputs = false;         ///< whether depth and shadow maps are compared
  bool strict = false;              ///< whether a note ends it before a picture is written
  tyndall::Changes changes = tyndall::Changes::Unknown; ///< how frames after the first reuse what they can
  tyndall::Tuning tuning;
  std::optional<int> repeat;                     ///< none: render once, without a warm-up
  std::optional<std::filesystem::path> programs; ///< where linked programs are kept; none: all are compiled
  std::optional<host::ContextKind> context;      ///< none: host::defaultContextKind()
  std::vector<std::filesystem::path> out;
  std::optional<std::filesystem::path> stats;
  std::optional<double> exposureStops; ///< none: by the picture's brightness
};

/// Pixels per side that are rendered.
inline int renderedWidth(const Options& options) { return options.width * options.supersample; }
inline int renderedHeight(const Options& options) { return options.height * options.supersample; }

/// The numbers of the share's frames; 0 for a picture that is none of an animation's.
std::vector<int> framesOf(const Options& options);

/// Throws UsageError or Answer (CommandLine.h).
Options parseOptions(int argc, const char* const* argv);

} // namespace render
