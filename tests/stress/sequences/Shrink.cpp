#include "Shrink.h"

#include <cstdio>

namespace stress {

int frameOf(const std::string& trouble) {
  int frame = -1;
  return std::sscanf(trouble.c_str(), "frame %d:", &frame) == 1 ? frame : -1;
}

Recipe shrunk(const Recipe& recipe, const std::string& trouble, const Run& run) {
  Recipe best = recipe;
  if (const int frame = frameOf(trouble); frame >= 0) best.frames = frame + 1;
  const auto take = [&](Recipe smaller) {
    const std::optional<std::string> still = run(smaller);
    if (!still) return false;
    if (const int frame = frameOf(*still); frame >= 0) smaller.frames = frame + 1;
    best = smaller;
    return true;
  };
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    for (int i = 0; i < static_cast<int>(Ingredient::Count); ++i) {
      Recipe smaller = best;
      if (smaller.without.insert(static_cast<Ingredient>(i)).second) goesOn = take(smaller) || goesOn;
    }
    for (int frame = 0; frame < best.frames - 1; ++frame) {
      Recipe smaller = best;
      if (smaller.skipped.insert(frame).second) goesOn = take(smaller) || goesOn;
    }
  }
  return best;
}

} // namespace stress
