// How a picture is drawn while things move: as well as a frame time allows.
#pragma once

#include <settings/State.h>

namespace viewer {

/// The levels, from the state as it is, 0, to the fastest.
int qualityLevels();

/// The state at a level: fewer pixels, a faster profile where the settings are those of a slower one, smaller shadow
/// maps. It is never better than the state itself.
settings::State atLevel(const settings::State& state, int level);

/// Chooses a level by the times of the frames before.
class Quality {
public:
  /// Milliseconds from one frame to the next while something moves.
  void setTarget(double milliseconds) { target_ = milliseconds; }
  double target() const { return target_; }

  int level() const { return level_; }
  /// A frame of the level took so long.
  void drew(double milliseconds);

private:
  double target_ = 100;
  int level_ = 2; ///< as good as may be expected of a software rasteriser; a GPU is soon at 0
  int fastFrames_ = 0;
};

} // namespace viewer
