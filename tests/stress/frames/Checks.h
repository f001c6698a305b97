// What must hold for every frame, whatever it is made of.
#pragma once

#include "Case.h"

#include <map>
#include <set>

namespace stress {

/// Something that does not hold.
struct Finding {
  std::string check; ///< RUN: WHAT, as "tree: map-exact"
  double value = 0;
  double limit = 0;
  std::string detail;
};

/// The rRMSE above which a picture needs an explanation.
inline constexpr double kTolerance = 0.05;

struct Outcome {
  std::vector<Finding> findings;
  std::map<std::string, double> errors;    ///< rRMSE by run: against map-exact for exact, against exact for the others
  std::vector<std::string> illConditioned; ///< runs whose error is what rounding the inputs to floats comes to
  int pictures = 0;                        ///< that were drawn
};

/// By which names runs are asked for: "exact", which is always drawn, techniques and profiles, "any settings",
/// "relation".
const std::vector<std::string>& runNames();

/// Draws the frame by techniques and profiles, and in its relation; `runs` empty: by all.
/// With `pictures`, a folder, each is written there as SEED-RUN.f32: RGB floats, row 0 at the bottom.
Outcome check(const Case& made, tyndall::Effect& effect, const std::set<std::string>& runs = {},
              const std::string& pictures = "");

} // namespace stress
