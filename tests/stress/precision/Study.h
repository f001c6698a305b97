// The precision study: what the picture loses when a texture of the effect's own is stored in another format.
#pragma once

#include "Formats.h"
#include "reference/Metrics.h"

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace precision {

/// A line of the study: rows of the table of targets that hold the same quantity in the same format.
struct Line {
  std::string name;   ///< that rows give
  std::string format; ///< GL's
  std::vector<std::string> targets;
  bool isBound = false; ///< pairs of a least and a greatest depth
};

/// In the order of the table.
const std::vector<Line>& studyLines();

/// Errors of the picture against the same pipeline in 32-bit floats.
struct Loss {
  reference::ErrorMetrics worst; ///< of the scene with the largest rRmse
  std::string scene;
};

struct LineResult {
  Line line;
  float least = 0, greatest = 0; ///< of what was stored, in all scenes
  int scenes = 0;                ///< that use it
  std::map<Format, Loss> losses;
};

struct SceneResult {
  std::string scene;
  bool hasTruth = false;
  reference::ErrorMetrics wide, stored; ///< against map-exact: in 32-bit floats, and as the effect stores it
  reference::ErrorMetrics difference;   ///< of the two
};

struct Study {
  std::vector<LineResult> lines;
  std::vector<SceneResult> scenes;
};

/// Runs it, writing each single error into `csv` (line,stored,format,scene,rRMSE,p99,max). Needs a running Catch
/// session.
Study runStudy(std::ostream& csv);

/// The tables of the README.
std::string markdown(const Study& study);

} // namespace precision
