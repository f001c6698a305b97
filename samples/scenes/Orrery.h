// What the orrery's hall and its bodies share, metres. The spindle stands on the y axis.
#pragma once

#include "Architecture.h"

namespace scenes::orrery {

constexpr double kHeart = 3.35;     ///< height of the armillary sphere's middle
constexpr double kMeridian = 1.3;   ///< radius of the ring that holds it
constexpr double kSpindleTop = 2.0; ///< the arms turn below

struct Palette {
  Masonry stone;
  Masonry web;
  int rib = 0;
  int floorLight = 0;
  int floorDark = 0;
  int daylight = 0;
  int lead = 0;
  int brass = 0;
  int darkBrass = 0;
  int steel = 0;
  int copper = 0;
  int gold = 0;
  int lapis = 0;
  int ivory = 0;
  int jade = 0;
  int ebony = 0;
};

/// Adds all that turns.
void addBodies(Scene& scene, const Palette& palette);

} // namespace scenes::orrery
