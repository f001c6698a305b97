// The command line of tyndall-render.
#pragma once

#include "CommandLine.h"

#include <filesystem>
#include <gl/Context.h>
#include <glm/glm.hpp>
#include <optional>
#include <settings/State.h>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace render {

struct Sun {
  glm::dvec3 direction{0};         ///< where the light travels to
  std::optional<glm::vec3> colour; ///< irradiance; the host's sun colour if not given
};

struct FrameRange {
  int first = 0;
  int last = 0;
  int count() const { return last - first + 1; }
};

struct Options : settings::State {
  std::optional<Sun> sun;                           ///< in place of all lights
  std::optional<std::filesystem::path> mediumFile;  ///< in place of State::medium
  std::optional<std::filesystem::path> ambientFile; ///< in place of State::ambient
  std::optional<std::filesystem::path> stateFile;   ///< that the options began with
  std::optional<FrameRange> frames; ///< none: frame 0, and one object in the statistics instead of a list
  std::optional<Share> share;       ///< none: all of the frames
  bool resume = false;              ///< whether frames whose files are whole stay as they are
  bool missing = false;             ///< whether to draw nothing, and name the frames that are not
  bool debug = true;                ///< whether the driver checks and tells, which takes time of the processor
  bool checkInputs = false;         ///< whether depth and shadow maps are compared
  bool strict = false;              ///< whether a note ends it before a picture is written
  std::optional<int> repeat;        ///< none: render once, without a warm-up
  std::optional<std::filesystem::path> programs; ///< where linked programs are kept; none: all are compiled
  std::optional<host::ContextKind> context;      ///< none: host::defaultContextKind()
  std::vector<std::filesystem::path> out;
  std::optional<std::filesystem::path> stats;
};

using settings::renderedHeight;
using settings::renderedWidth;

/// The numbers of the share's frames; 0 for a picture that is none of an animation's.
std::vector<int> framesOf(const Options& options);

/// Throws UsageError or Answer (CommandLine.h), or host::Error for a state file that cannot be used.
Options parseOptions(int argc, const char* const* argv);

} // namespace render
