// Frames that together use every texture of the effect's own, and those that strain a format most.
#pragma once

#include "reference/Ray.h"

#include <functional>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace precision {

struct Scene {
  std::string name;
  /// The same picture each time: inscatter, or colour where only that shows what is studied.
  std::function<reference::Image(tyndall::Effect& effect)> draw;
  /// What map-exact makes of it; none where the picture is not inscatter.
  std::function<reference::Image()> truth;
  tyndall::Tuning tuning = {};
  std::string line = {}; ///< of the study that it is for; empty: all that it uses
};

/// Each time anew; textures and rigs live as long as the scene.
std::vector<Scene> studyScenes();

} // namespace precision
