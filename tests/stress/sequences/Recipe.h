// Which sequence: its seed, its length, and what of it is left out.
#pragma once

#include "Random.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stress {

/// What varies in a sequence, each from random numbers of its own: one that is left out has its simplest value in every
/// frame, and the others stay as they are.
enum class Ingredient {
  Sizes,      ///< width and height of the picture
  Viewports,  ///< colour and outputs are larger than the viewport
  Cameras,    ///< poses and kinds of projection
  Jitter,     ///< Camera::jitter
  Eyes,       ///< several, in any order
  Lights,     ///< kinds, and that they come and go
  LightMoves, ///< colours and directions
  Maps,       ///< sizes, formats and layouts of shadow maps
  Glass,
  Media,
  Settings,
  Techniques,
  Modes, ///< Changes
  Versions,
  Movers, ///< boxes that move, appear and vanish
  Meshes, ///< of these boxes
  Refresh,
  FullShare,
  Views,    ///< debug views
  Targets,  ///< colour or outputs, and their formats
  Depths,   ///< format of the depth, and where in its texture it is
  Textures, ///< deleted and made anew between frames, whose names GL gives again
  Failures, ///< frames that are refused, fail or are abandoned
  Configs,  ///< Config
  Count
};

const char* nameOf(Ingredient ingredient);

/// Throws std::invalid_argument.
Ingredient ingredientNamed(std::string_view name);

struct Recipe {
  std::uint64_t seed = 0;
  int frames = 20;
  std::set<int> skipped = {}; ///< frames, from 0 on, that are not drawn
  std::set<Ingredient> without = {};

  bool has(Ingredient ingredient) const { return without.count(ingredient) == 0; }

  /// Of one frame, or with -1 of the sequence.
  Random random(Ingredient ingredient, int frame) const {
    return Random(mixed(mixed(seed, static_cast<std::uint64_t>(ingredient)), static_cast<std::uint64_t>(frame + 1)));
  }
};

/// The command line that runs it alone.
std::string commandOf(const Recipe& recipe);

} // namespace stress
