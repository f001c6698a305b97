// The dimensions that the church and its furniture share, metres. The nave runs along z, the altar at -z.
#pragma once

#include "Glazing.h"

namespace scenes::nave {

constexpr int kBays = 7;
constexpr double kBay = 5.5;
constexpr double kHalfLength = 0.5 * kBays * kBay;
constexpr double kArcadeX = 5.0; ///< centre of the arcade
constexpr double kArcadeHalf = 0.45;
constexpr double kAisleX = 9.5; ///< inner face of the outer wall

struct Palette {
  Masonry stone;   ///< walls
  Masonry web;     ///< vaults
  Masonry pillars; ///< columns
  int rib = 0;
  int floorLight = 0;
  int floorDark = 0;
  int wood = 0;
  int darkWood = 0;
  int cloth = 0;
  int gold = 0;
  int wax = 0;
  int flame = 0;
  int daylight = 0;
  Glass glass;
};

void furnish(MeshBuilder& mesh, const Palette& palette);

} // namespace scenes::nave
