// What the stage and its props share, metres. The audience sits at +z.
#pragma once

#include "Architecture.h"

namespace scenes::stage {

constexpr double kFloor = 1.0; ///< of the stage, above that of the auditorium

struct Palette {
  Masonry planks;
  Masonry wall;
  int blackWall = 0;
  int steel = 0;
  int blackSteel = 0;
  int curtain = 0;
  int backdrop = 0;
  int gilding = 0;
  int seat = 0;
  int wood = 0;
  int plaster = 0;
  int paper = 0;
};

/// A lattice girder of square section from a to b.
void truss(MeshBuilder& mesh, const glm::dvec3& a, const glm::dvec3& b, double side);
/// The lamp's housing and yoke; the light sits in it at the frame's origin and shines along +y.
void lampHousing(MeshBuilder& mesh);
/// Parallel slats across the beam.
void louvre(MeshBuilder& mesh, double distance, double halfWidth, int slats);
/// A wheel of spokes and rings across the beam.
void wheel(MeshBuilder& mesh, double distance, double radius, int spokes);
void props(MeshBuilder& mesh, const Palette& palette);
void seats(MeshBuilder& mesh, const Palette& palette);

} // namespace scenes::stage
